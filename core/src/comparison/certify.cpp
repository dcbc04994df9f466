// SPDX-License-Identifier: Apache-2.0
#include "comparison/certify.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "comparison/ranking.hpp"
#include "plugins/default_options.hpp"
#include "plugins/limited_work.hpp"
#include "results/keys.hpp"
#include "text/escaped.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"
#include "uncertainty/refit.hpp"

namespace tunica::comparison {

namespace key = results::key;

namespace {

using json = nlohmann::ordered_json;

json to_json(const search::Neighbourhood& around) {
  json lowest = nullptr;
  if (around.lowest)
    lowest = {{key::objective, around.lowest->objective},
              {key::along, around.lowest->along},
              {key::step, around.lowest->step},
              {key::parameters, around.lowest->parameters}};
  return {{key::status, name(around.status.kind())},
          {key::reason, around.status.reason()},
          {key::violation, around.status.violation()},
          {key::objective, around.objective},
          {key::evaluated, around.evaluated},
          {key::infeasible, around.infeasible},
          {key::failed, around.failed},
          {key::left_out, around.left_out},
          {key::lowest, std::move(lowest)},
          {key::better, around.better},
          {key::constraints, around.constraints},
          {key::active_constraints, around.active_constraints}};
}

search::Neighbourhood from_json(const json& around) {
  search::Neighbourhood result;
  const std::string status = around.at(key::status);
  if (status == "failed") result.status = Status::failed(around.at(key::reason));
  if (status == "infeasible") result.status = Status::infeasible(around.at(key::reason), around.at(key::violation));
  result.objective = around.at(key::objective);
  result.evaluated = around.at(key::evaluated);
  result.infeasible = around.at(key::infeasible);
  result.failed = around.at(key::failed);
  result.left_out = around.at(key::left_out);
  if (const auto& lowest = around.at(key::lowest); !lowest.is_null())
    result.lowest = {lowest.at(key::objective), lowest.at(key::step), lowest.at(key::along),
                     lowest.at(key::parameters)};
  result.better = around.at(key::better);
  result.constraints = around.at(key::constraints);
  result.active_constraints = around.at(key::active_constraints);
  return result;
}

[[noreturn]] void refuse(const std::string& what) {
  throw InputError(
      fmt::format("result.json and input.json do not belong together: {}; take a folder that `tunica run` "
                  "has written",
                  what));
}

const json& run_named(const json& result, const std::string& label) {
  for (const auto& run : result.at(key::runs))
    if (run.at(key::run) == label) return run;
  refuse(fmt::format("there is no run '{}' in the result", label));
}

/// A local search from the lowest point that is known, where that is cheap. Where it comes lower by more than searches
/// resolve, its end is the lowest.
void refine(const assembly::Assembly& assembly, const plugins::Catalogue& catalogue, const std::vector<double>& free,
            const plugins::LimitedWork& work, search::Neighbourhood& around) {
  constexpr double resolved = 1e-6;  // of the objective
  const auto* const refiner = catalogue.refiner();
  if (refiner == nullptr || !around.status.ok() || assembly.layout().has_costly_tests || work.is_over()) return;
  Options options = plugins::default_options(refiner->factory.options);
  options.set("starts", std::int64_t{1});
  uncertainty::RefitObjective target;
  target.residual_count = assembly.layout().residual_count;
  target.blocks = assembly.layout().blocks;
  target.evaluate = [&](std::span<const double> at, double& objective, std::span<double> residuals,
                        std::span<double> jacobian, assembly::Workspace& own) {
    if (work.is_over()) return Status::failed("max_time was over");
    return assembly.evaluator().evaluate(at, objective, {}, residuals, jacobian, own);
  };
  const auto workspace = assembly.evaluator().make_workspace();
  const double lowest = around.better ? around.lowest->objective : around.objective;
  auto made = uncertainty::refit(assembly, target, {refiner, std::move(options)},
                                 around.better ? around.lowest->parameters : free, std::nullopt, 0, *workspace);
  if (!made.status.ok() || !(lowest - made.objective > resolved * std::abs(lowest) + 1e-12)) return;
  around.better = true;
  around.lowest = {made.objective, 0, "a local search", std::move(made.free)};
}

/// Why the intervals of a run are meaningless: they surround a point that is not the optimum. Empty if they are valid.
std::string doubt_of_intervals(const RunSummary& run) {
  constexpr double moved = 0.5;  // half widths
  const auto& certificate = run.certificate;
  if (certificate.verdict == CertificateVerdict::not_an_optimum)
    return "the best point is not an optimum, and intervals around it would not hold the optimum";
  if (!certificate.fresh || !certificate.fresh->around.better) return "";
  const auto& there = certificate.fresh->around.lowest->parameters;
  for (std::size_t j = 0; j < run.parameters.size() && j < there.size(); ++j) {
    const Estimate& estimate = run.parameters[j];
    if (!estimate.ci95) continue;
    const double half = (estimate.ci95->second - estimate.ci95->first) / 2;
    if (const double far = std::abs(there[j] - estimate.value); far > moved * half)
      return fmt::format(
          "a better point lies {:.2g} half-widths away in {}, so the interval would not hold the optimum", far / half,
          estimate.name);
  }
  return "";
}

void withhold_intervals(RunSummary& run) {
  for (Estimate& estimate : run.parameters) estimate.ci95.reset();
  run.covariance = {};
  run.curve_ci95.clear();
}

}  // namespace

std::string best_points_json(const Summary& summary) {
  json runs = json::array();
  for (const auto& run : summary.runs) {
    json best = nullptr;
    if (run.has_result) {
      best = {{key::objective, run.objective}, {key::parameters, json::object()}};
      for (const auto& parameter : run.parameters)
        best[key::parameters][parameter.name] = {{key::value, parameter.value}};
    }
    runs.push_back({{key::run, run.label}, {key::best, std::move(best)}});
  }
  const json document = {{key::runs, std::move(runs)}};
  return document.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

std::string certify(const execution::Plan& plan, const std::string& result_json,
                    std::vector<std::string>* contradictions, const plugins::Catalogue* catalogue) {
  json runs = json::array();
  try {
    const json result = detail::parse_json<json>(result_json);
    for (const auto& planned : plan.runs) {
      const json& run = run_named(result, planned.label);
      if (run.at(key::best).is_null()) continue;
      const json& values = run.at(key::best).at(key::parameters);
      std::vector<double> free;
      for (const auto& parameter : planned.assembly->layout().parameters) {
        if (!values.contains(parameter.name))
          refuse(fmt::format("run '{}' has no parameter '{}'", planned.label, parameter.name));
        free.push_back(values.at(parameter.name).at(key::value));
      }
      const auto deadline = plugins::deadline_after(planned.entry->stop.max_time);
      auto around = search::probe_neighbourhood(*planned.assembly, free, deadline);
      if (catalogue) refine(*planned.assembly, *catalogue, free, plugins::LimitedWork("refinement", deadline), around);
      json entry = to_json(around);
      const double recorded = run.at(key::best).at(key::objective), now = entry.at(key::objective);
      entry[key::run] = planned.label;
      entry[key::recorded] = recorded;
      entry[key::difference] = now - recorded;
      entry[key::identical] = std::bit_cast<std::uint64_t>(now) == std::bit_cast<std::uint64_t>(recorded);
      if (contradictions && around.status.kind() == Status::Kind::failed)
        contradictions->push_back(
            fmt::format("{}: the best point cannot be evaluated: {}", planned.label, around.status.reason()));
      else if (contradictions && !search::same_objective(now, recorded))
        contradictions->push_back(
            fmt::format("{}: not confirmed: result.json records the objective {}, but evaluated again it "
                        "is {}",
                        planned.label, recorded, now));
      runs.push_back(std::move(entry));
    }
  } catch (const json::exception& problem) {
    throw InputError(fmt::format("result.json cannot be understood: {}; make it again with `tunica run`",
                                 text::json_problem(problem.what())));
  }
  const json document = {{key::runs, std::move(runs)}};
  return document.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

bool add_certificates(const std::string& certified, const std::string& missing, Summary& summary) {
  const json document = detail::parse_json<json>(certified, false);
  bool refuted = false, withheld = false;
  for (auto& run : summary.runs) {
    if (!run.has_result) continue;
    auto& certificate = run.certificate;
    certificate.missing = missing;
    if (!document.is_discarded()) {
      try {
        const json& entry = run_named(document, run.label);
        certificate.fresh = {from_json(entry), entry.at(key::difference), entry.at(key::identical)};
      } catch (const std::exception& problem) {  // another program answered; say so rather than stop
        certificate.missing = problem.what();
      }
    }
    judge(certificate);
    refuted = refuted || certificate.refuted();
    run.withheld = doubt_of_intervals(run);
    if (!run.withheld.empty()) {
      withhold_intervals(run);
      withheld = true;
    }
    if (auto warning = certificate_warning(run.label, certificate)) summary.warnings.push_back(std::move(*warning));
  }
  if (refuted) {
    summary.ranking = rank(summary.runs);
    compare_information(summary.runs, summary.ranking);
  }
  return refuted || withheld;
}

}  // namespace tunica::comparison
