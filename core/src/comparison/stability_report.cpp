// SPDX-License-Identifier: Apache-2.0
#include "comparison/stability_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "comparison/run_differences.hpp"
#include "results/keys.hpp"
#include "text/terminal.hpp"
#include "text/wrapping.hpp"

namespace tunica::comparison {

namespace key = results::key;
namespace {

using json = nlohmann::ordered_json;

const char* direction(std::size_t axis) { return axis == 0 ? "circumferential" : "axial"; }

std::vector<double> values_of(const RunSummary& run) {
  std::vector<double> free;
  for (const auto& parameter : run.parameters) free.push_back(parameter.value);
  return free;
}

/// The best objective without constraints of each model in each group.
std::map<std::string, double> free_objectives(const execution::Plan& plan, const Summary& summary) {
  std::map<std::string, double> best;
  for (std::size_t run = 0; run < summary.runs.size(); ++run) {
    const auto& entry = summary.runs[run];
    if (!entry.has_result || !plan.runs[run].entry->constraints.empty()) continue;
    const auto [found, added] = best.emplace(entry.model + '\n' + entry.group, entry.objective);
    if (!added) found->second = std::min(found->second, entry.objective);
  }
  return best;
}

/// Stretches that the constraints of a run state.
void add_asked(const experiment::RunEntry& run, stability::Domain& domain) {
  constexpr int points = 100;
  for (const auto& constraint : run.constraints)
    for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
      if (!constraint.range || !constraint.directions[axis]) continue;
      const auto [first, last] = *constraint.range;
      for (int k = 0; k <= points; ++k) domain.asked[axis].push_back(first + (last - first) * k / points);
    }
}

/// The least stretch that all paths were followed to; null where one was not at all.
json reached(const std::vector<stability::PathReach>& followed) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& path : followed)
    if (path.to >= 1) least = std::min(least, path.to);  // a path that is pressed ends below 1
  return std::isfinite(least) && least > 1 ? json(least) : json(nullptr);
}

json condition(const std::optional<double>& first_lost, const std::string& path,
               const std::vector<stability::PathReach>& followed) {
  const bool any = std::any_of(followed.begin(), followed.end(), [](const auto& one) { return one.to != 1; });
  json paths = json::object();
  for (const auto& one : followed) paths[one.path] = one.to != 1 ? json(one.to) : json(nullptr);
  return {{key::holds, any ? json(!first_lost.has_value()) : json(nullptr)},
          {key::first_lost, first_lost ? json(*first_lost) : json(nullptr)},
          {key::path, path},
          {key::checked_to, reached(followed)},
          {key::paths, std::move(paths)}};
}

json optional_number(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

json model_json(const StabilitySummary::OfModel& found) {
  json directions = json::array();
  for (const auto& verdict : found.verdict.transverse)
    directions.push_back({{key::direction, direction(verdict.axis)},
                          {key::measured_from, verdict.judged_from < 1 ? json(verdict.judged_from) : json(nullptr)},
                          {key::measured_to, verdict.judged_to > 1 ? json(verdict.judged_to) : json(nullptr)},
                          {key::stable, verdict.stable ? json(*verdict.stable) : json(nullptr)},
                          {key::first_unstable, optional_number(verdict.first_unstable)},
                          {key::stable_again, optional_number(verdict.stable_again)},
                          {key::first_unstable_pressed, optional_number(verdict.first_unstable_pressed)},
                          {key::checked_from, verdict.checked_from},
                          {key::checked_to, verdict.checked_to}});
  const auto& ellipticity = found.verdict.ellipticity;
  const auto& drucker = found.verdict.drucker;
  const auto& faces = found.verdict.free_faces;
  return {{key::transverse, std::move(directions)},
          {key::ellipticity, condition(ellipticity.first_lost, ellipticity.path, ellipticity.followed)},
          {key::drucker, drucker ? condition(drucker->first_lost, drucker->path, drucker->followed) : json(nullptr)},
          {key::free_faces, faces ? condition(faces->first_lost, faces->path, faces->followed) : json(nullptr)},
          {key::inadmissible, found.inadmissible},
          {key::sentences, found.verdict.sentences()}};
}

}  // namespace

std::optional<bool> StabilitySummary::transversely_stable() const {
  stability::Admissibility all;
  for (const OfModel& model : models)
    all.transverse.insert(all.transverse.end(), model.verdict.transverse.begin(), model.verdict.transverse.end());
  return all.transversely_stable();
}

stability::Domain domain_of(const assembly::Assembly& assembly, std::size_t model, std::optional<double> to) {
  stability::Domain domain;
  if (to) {
    constexpr int points = 100;
    domain.largest = *to;
    for (auto& stretches : domain.asked)
      for (int k = 1; k <= points; ++k) stretches.push_back(1 + (*to - 1) * k / points);
    return domain;
  }
  for (const auto& strip : assembly.models().strips()) {
    if (strip.model != model) continue;
    domain.strips[strip.axis].insert(domain.strips[strip.axis].end(), strip.stretches.begin(), strip.stretches.end());
  }
  if (assembly.models().largest_stretch() > 1) domain.largest = assembly.models().largest_stretch();
  return domain;
}

StabilitySummary stability_of(const assembly::Assembly& assembly, std::span<const double> free,
                              std::optional<double> to) {
  StabilitySummary found;
  const auto& models = assembly.models();
  for (std::size_t m = 0; m < models.count(); ++m)
    found.models.push_back(
        {models.name(m),
         stability::judge_admissibility(models.model(m), models.parameters(m, free), domain_of(assembly, m, to)),
         {}});
  return found;
}

void add_stability(const execution::Plan& plan, Summary& summary) {
  const auto unconstrained = free_objectives(plan, summary);
  for (std::size_t run = 0; run < summary.runs.size(); ++run) {
    auto& entry = summary.runs[run];
    if (!entry.has_result) continue;
    const auto& assembly = *plan.runs[run].assembly;
    StabilitySummary found{constraints_in_words(*plan.runs[run].entry), {}, {}};
    for (std::size_t m = 0; m < assembly.models().count(); ++m) {
      const auto parameters = assembly.models().parameters(m, values_of(entry));
      auto domain = domain_of(assembly, m);
      add_asked(*plan.runs[run].entry, domain);
      domain.largest = plan.experiment->analysis.stability_to.value_or(domain.largest);
      found.models.push_back({assembly.models().name(m),
                              stability::judge_admissibility(assembly.models().model(m), parameters, domain),
                              {}});
      for (const auto& inequality : assembly.models().model(m).describe().admissible) {
        const double value = inequality.value(parameters);
        if (value < -1e-9)
          found.models.back().inadmissible.push_back(fmt::format("{} = {:.4g}", inequality.name, value));
      }
    }
    const auto free = unconstrained.find(entry.model + '\n' + entry.group);
    // Over a perfect fit the ratio says nothing.
    if (!found.imposed.empty() && entry.status.ok() && free != unconstrained.end() &&
        free->second > 1e-6 * entry.objective)
      found.ratio_to_free = entry.objective / free->second;
    entry.stability = std::move(found);
  }
}

std::string stability_table(const Summary& summary) {
  std::size_t width = 5;
  bool any = false;
  for (const auto& run : summary.runs)
    if (run.stability) {
      any = true;
      width = std::max(width, text::columns(run.label));
    }
  if (!any) return {};
  constexpr std::size_t widest_label = 17, widest_constraint = 10;  // so that the row fits into 80 columns
  width = std::min(width, widest_label);
  std::string text = "Transverse stability (λ3 falls as the strip is pulled)\n";
  text += fmt::format("  {}  {:<10} {:>12} {:>7}  {:<6} λ3 grows from\n", text::pad("run", width), "imposed",
                      "objective", "x free", "stable");
  for (const auto& run : summary.runs) {
    if (!run.stability) continue;
    const auto& found = *run.stability;
    std::vector<std::string> where;
    for (const auto& model : found.models)
      for (const auto& verdict : model.verdict.transverse)
        if (verdict.first_unstable && *verdict.first_unstable < 2 * model.verdict.domain.largest)
          where.push_back(fmt::format("{:.3f} {}{}", *verdict.first_unstable, verdict.axis == 0 ? "circ" : "axial",
                                      found.models.size() > 1 ? " (" + model.name + ')' : ""));
    const std::optional<bool> stable = found.transversely_stable();
    std::string label = run.label, imposed = found.imposed.empty() ? "-" : found.imposed;
    if (text::columns(label) > width || text::columns(imposed) > widest_constraint) {
      const bool with_constraint = text::columns(imposed) > widest_constraint;
      text += text::hanging(fmt::format("  {}{}", text::shortened(label, 77), with_constraint ? ": " : ""),
                            with_constraint ? imposed : "") +
              '\n';
      label.clear();
      if (with_constraint) imposed.clear();
    }
    const std::string row =
        fmt::format("  {}  {} {:>#12.6g} {:>7}  {:<6}", text::pad(label, width), text::pad(imposed, widest_constraint),
                    run.objective, found.ratio_to_free ? fmt::format("{:.3g}", *found.ratio_to_free) : "",
                    !stable   ? "-"
                    : *stable ? "yes"
                              : "NO");
    // The list is wrapped in its own column, which begins beyond the middle of the line.
    const std::size_t begins = text::columns(row) + 1;
    const std::string list =
        text::hanging("", fmt::format("{}", fmt::join(where, ", ")), 80 - std::min<std::size_t>(begins, 79));
    text += row;
    for (std::size_t from = 0; from < list.size();) {
      const std::size_t end = std::min(list.find('\n', from), list.size());
      text += (from == 0 ? " " : '\n' + std::string(begins, ' ')) + list.substr(from, end - from);
      from = end + 1;
    }
    text += '\n';
  }
  const auto& runs = summary.runs;
  const bool any_ratio = std::any_of(
      runs.begin(), runs.end(), [](const RunSummary& run) { return run.stability && run.stability->ratio_to_free; });
  if (any_ratio)
    text += text::hanging(
                "   ", "x free: objective over that of the best run of the same model and tests without constraints") +
            '\n';
  return text;
}

json stability_json(const RunSummary& run) {
  if (!run.stability) return nullptr;
  const auto& found = *run.stability;
  json result = {{key::imposed, found.imposed.empty() ? json(nullptr) : json(found.imposed)},
                 {key::ratio_to_free, optional_number(found.ratio_to_free)}};
  if (found.models.size() == 1) {
    result.update(model_json(found.models.front()));
  } else {
    for (const auto& model : found.models) result[key::models][model.name] = model_json(model);
  }
  return result;
}

}  // namespace tunica::comparison
