// SPDX-License-Identifier: Apache-2.0
#include "comparison/study_tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "comparison/performance.hpp"
#include "comparison/ranking.hpp"
#include "comparison/success.hpp"
#include "execution/evaluation_table.hpp"
#include "execution/files.hpp"
#include "text/csv.hpp"

namespace tunica::comparison {

namespace {

using text::csv_cell;

template <class Number>
std::string cell(const std::optional<Number>& number) {
  return number ? fmt::format("{}", *number) : "";
}

/// Empty where the optimiser came back by itself.
std::string_view stop_code(search::StopReason reason) {
  return reason == search::StopReason::none ? std::string_view() : search::code(reason);
}

std::string line(const std::vector<std::string>& cells) { return fmt::format("{}\n", fmt::join(cells, ",")); }

/// Evaluation counts to show: the first and the last improvement, the end, and 20 a decade between them.
std::vector<std::uint64_t> shown(const execution::RealisationResult& realisation) {
  const std::uint64_t first = realisation.trace.front().evaluations, last = realisation.trace.back().evaluations,
                      end = realisation.tally.evaluations;
  std::vector<std::uint64_t> at{first, last, end};
  for (int k = 0;; ++k) {
    const auto decade = static_cast<std::uint64_t>(std::ceil(std::pow(10, k / 20.0)));
    if (decade >= end) break;
    if (decade > first) at.push_back(decade);
  }
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

std::string profile_csv(const std::string& comment, const std::string& cost, const std::vector<ProfileCurve>& curves) {
  std::string text = comment + line({"optimizer", cost, "fraction", "problems"});
  for (const auto& curve : curves)
    for (const auto& [x, share] : curve.steps)
      text += fmt::format("{},{},{:.12g},{}\n", csv_cell(curve.optimizer), x, share, curve.problems);
  return text;
}

}  // namespace

std::string ranking_csv(const execution::Plan& plan, const Summary& summary) {
  std::string text = line({"rank",
                           "run",
                           "model",
                           "optimizer",
                           "tests",
                           "objective_type",
                           "constraints",
                           "status",
                           "reason",
                           "objective",
                           "median",
                           "worst",
                           "realisations",
                           "successes",
                           "success_rate",
                           "success_low",
                           "success_high",
                           "success_threshold",
                           "median_evaluations_to_target",
                           "expected_running_time",
                           "evaluations_total",
                           "jacobians_total",
                           "failures",
                           "infeasible",
                           "seconds [s]",
                           "aicc",
                           "bic",
                           "delta_aicc",
                           "chi_square",
                           "degrees_of_freedom",
                           "reduced_chi_square",
                           "full_simulations",
                           "cost",
                           "differs_by",
                           "paired_with"});
  for (const auto& entry : summary.ranking) {
    const auto& run = summary.runs[entry.run];
    const auto& planned = *plan.runs[entry.run].entry;
    std::string constraints;
    for (const auto& constraint : planned.constraints)
      constraints += (constraints.empty() ? "" : " ") + constraint.json;
    const auto& box = run.objectives.box;
    const auto& to_target = run.evaluations_to_target.box;
    const auto some = [&](double value) { return run.has_result ? fmt::format("{}", value) : std::string(); };
    text += line({cell(entry.rank),
                  csv_cell(run.label),
                  csv_cell(run.model),
                  csv_cell(run.optimizer),
                  csv_cell(fmt::format("{}", fmt::join(run.tests, " "))),
                  name_of(planned.objective),
                  csv_cell(constraints),
                  name(run.status.kind()),
                  csv_cell(reason_of_rank(run)),
                  some(run.objective),
                  box ? fmt::format("{}", box->median) : "",
                  box ? fmt::format("{}", box->max) : "",
                  fmt::format("{}", run.realisations),
                  fmt::format("{}", run.successes),
                  fmt::format("{}", run.success_rate),
                  fmt::format("{}", run.success_ci95.first),
                  fmt::format("{}", run.success_ci95.second),
                  std::isfinite(run.threshold) ? some(run.threshold) : "",
                  to_target ? fmt::format("{}", to_target->median) : "",
                  cell(run.expected_running_time),
                  fmt::format("{}", run.evaluations),
                  fmt::format("{}", run.jacobians),
                  fmt::format("{}", run.failures),
                  fmt::format("{}", run.infeasible),
                  fmt::format("{}", run.seconds),
                  run.information ? cell(run.information->aicc) : "",
                  run.information ? fmt::format("{}", run.information->bic) : "",
                  cell(entry.delta_aicc),
                  run.misfit ? fmt::format("{}", run.misfit->chi_square) : "",
                  run.misfit ? fmt::format("{}", run.misfit->freedom) : "",
                  run.misfit ? fmt::format("{}", run.misfit->per_freedom()) : "",
                  run.has_costly_tests ? fmt::format("{}", run.simulated) : "",
                  cell(run.cost()),
                  csv_cell(fmt::format("{}", fmt::join(run.differs, ", "))),
                  csv_cell(fmt::format("{}", fmt::join(run.paired_with, " ")))});
  }
  return text;
}

std::string realisations_csv(const execution::Plan& plan, const std::vector<execution::RunResult>& results,
                             const Summary& summary) {
  std::vector<std::string> columns;
  const auto column = [](const assembly::FreeParameter& p) { return csv_cell(fmt::format("{} [{}]", p.name, p.unit)); };
  for (const auto& run : plan.runs)
    for (const auto& parameter : run.assembly->layout().parameters)
      if (std::find(columns.begin(), columns.end(), column(parameter)) == columns.end())
        columns.push_back(column(parameter));
  std::vector<std::string> header{"run", "realisation", "objective"};
  header.insert(header.end(), columns.begin(), columns.end());
  for (const char* name :
       {"evaluations", "evaluations_to_target", "status", "ended_by", "seconds [s]", "success", "stop_reason"})
    header.emplace_back(name);
  std::string text = line(header);
  for (std::size_t run = 0; run < plan.runs.size(); ++run) {
    const auto& parameters = plan.runs[run].assembly->layout().parameters;
    for (const auto& realisation : results[run].realisations) {
      const auto& best = realisation.best;
      std::vector<std::string> cells{csv_cell(summary.runs[run].label), fmt::format("{}", realisation.realisation),
                                     best.found() ? fmt::format("{}", best.objective) : ""};
      for (const auto& name : columns) {
        const auto own = std::find_if(parameters.begin(), parameters.end(),
                                      [&](const auto& parameter) { return column(parameter) == name; });
        const bool has = best.found() && own != parameters.end();
        cells.push_back(has ? fmt::format("{}", best.parameters[static_cast<std::size_t>(own - parameters.begin())])
                            : "");
      }
      const auto reached = evaluations_to(realisation, summary.runs[run].threshold);
      cells.push_back(fmt::format("{}", realisation.tally.evaluations));
      cells.push_back(cell(reached));
      cells.emplace_back(best.feasible() ? "ok" : best.found() ? "infeasible" : "failed");
      cells.push_back(csv_cell(realisation.stop_sentence.empty() ? realisation.reason : realisation.stop_sentence));
      cells.push_back(fmt::format("{}", realisation.seconds));
      cells.emplace_back(reached ? "1" : "0");
      cells.emplace_back(stop_code(realisation.stopped_by));
      text += line(cells);
    }
  }
  return text;
}

std::string statistics_csv(const Summary& summary) {
  std::string text =
      "# Over the realisations of each run that have a feasible point: what another seed would give. ci95: of the "
      "mean.\n"
      "run,quantity,unit,realisations,mean,sd,ci95_low,ci95_high,min,q1,median,q3,max\n";
  const auto row = [&](const RunSummary& run, const std::string& name, const std::string& unit,
                       const SampleStatistics& sample) {
    if (sample.count == 0) return;
    const auto& box = *sample.box;
    text +=
        line({csv_cell(run.label), csv_cell(name), unit, fmt::format("{}", sample.count),
              fmt::format("{}", sample.mean), cell(sample.sd), sample.ci95 ? fmt::format("{}", sample.ci95->first) : "",
              sample.ci95 ? fmt::format("{}", sample.ci95->second) : "", fmt::format("{}", box.min),
              fmt::format("{}", box.lower), fmt::format("{}", box.median), fmt::format("{}", box.upper),
              fmt::format("{}", box.max)});
  };
  for (const auto& run : summary.runs) {
    row(run, "objective", "1", run.objectives);
    for (const auto& parameter : run.parameters) row(run, parameter.name, parameter.unit, parameter.over_realisations);
    row(run, "evaluations", "1", run.evaluations_spent);
    row(run, "evaluations_to_target", "1", run.evaluations_to_target);
    row(run, "seconds", "s", run.seconds_spent);
  }
  return text;
}

std::string convergence_csv(const std::vector<execution::RunResult>& results, const Summary& summary) {
  std::string text =
      "# Best feasible objective after so many evaluations. Rows: the first and the last improvement, the end of the\n"
      "# search, and between them the counts ceil(10^(k/20)) at which the best differs from that of the row before.\n"
      "run,realisation,evaluation,objective\n";
  for (std::size_t run = 0; run < results.size(); ++run)
    for (const auto& realisation : results[run].realisations) {
      if (realisation.trace.empty()) continue;
      std::size_t next = 0;  // first improvement that is still to come
      double written = std::numeric_limits<double>::infinity();
      const auto counts = shown(realisation);
      for (const auto count : counts) {
        while (next < realisation.trace.size() && realisation.trace[next].evaluations <= count) ++next;
        const double best = realisation.trace[next - 1].objective;
        if (best == written && count != counts.back()) continue;
        written = best;
        text += fmt::format("{},{},{},{}\n", csv_cell(summary.runs[run].label), realisation.realisation, count, best);
      }
    }
  return text;
}

void write_study_tables(const std::filesystem::path& directory, const execution::Plan& plan,
                        const std::vector<execution::RunResult>& results, const Summary& summary) {
  execution::write_atomically(directory / "ranking.csv", ranking_csv(plan, summary));
  execution::write_atomically(directory / "realisations.csv", realisations_csv(plan, results, summary));
  execution::write_atomically(directory / "statistics.csv", statistics_csv(summary));
  execution::write_atomically(directory / "convergence.csv", convergence_csv(results, summary));
  if (plan.tasks.size() < 2) return;
  const auto made = profiles(plan, results, summary.runs);
  execution::write_atomically(
      directory / "performance_profile.csv",
      profile_csv("# Share of realisations (problems weigh the same) that succeed within tau times the least expected\n"
                  "# running time of any optimizer on the problem. Dolan and More, Math. Program. 91:201 (2002).\n",
                  "tau", made.performance));
  execution::write_atomically(
      directory / "data_profile.csv",
      profile_csv(
          "# Share of realisations (problems weigh the same) that succeed within so many evaluations, in units\n"
          "# of n + 1 for n free parameters. More and Wild, SIAM J. Optim. 20:172 (2009).\n",
          "evaluations_per_n_plus_1", made.data));
}

}  // namespace tunica::comparison
