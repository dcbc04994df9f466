// SPDX-License-Identifier: Apache-2.0
#include "comparison/success.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "comparison/ranking.hpp"

namespace tunica::comparison {

std::string problem_of(const experiment::RunEntry& run) {
  std::string key = run.model + ": " + group_of(run);
  for (const auto& constraint : run.constraints) key += ", " + constraint.json;
  return key;
}

std::optional<std::uint64_t> evaluations_to(const execution::RealisationResult& realisation, double threshold) {
  const auto& trace = realisation.trace;  // objectives fall
  const auto reached = std::partition_point(trace.begin(), trace.end(),
                                            [&](const auto& improvement) { return improvement.objective > threshold; });
  if (reached == trace.end()) return {};
  return reached->evaluations;
}

void count_successes(const execution::Plan& plan, const std::vector<execution::RunResult>& results,
                     std::vector<RunSummary>& runs) {
  std::map<std::string, double> best_known;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const std::string problem = problem_of(*plan.runs[run].entry);
    auto& best = best_known.emplace(problem, std::numeric_limits<double>::infinity()).first->second;
    for (const auto& realisation : results[run].realisations)
      if (realisation.best.feasible()) best = std::min(best, realisation.best.objective);
  }
  for (std::size_t run = 0; run < runs.size(); ++run) {
    auto& summary = runs[run];
    const auto& entry = *plan.runs[run].entry;
    summary.threshold = success_threshold(entry.stop.target, best_known.at(problem_of(entry)));
    std::vector<double> to_target, spent, seconds;
    double until_success = 0;
    for (const auto& realisation : results[run].realisations) {
      spent.push_back(static_cast<double>(realisation.tally.evaluations));
      seconds.push_back(realisation.seconds);
      const auto reached = evaluations_to(realisation, summary.threshold);
      if (reached) to_target.push_back(static_cast<double>(*reached));
      until_success += reached ? static_cast<double>(*reached) : spent.back();
    }
    const std::size_t trials = spent.size();
    summary.successes = to_target.size();
    summary.success_rate = trials == 0 ? 0 : static_cast<double>(summary.successes) / static_cast<double>(trials);
    summary.success_ci95 = wilson_interval(summary.successes, trials);
    summary.evaluations_to_target = sample_statistics(to_target);
    if (summary.successes > 0) summary.expected_running_time = until_success / static_cast<double>(summary.successes);
    summary.evaluations_spent = sample_statistics(spent);
    summary.seconds_spent = sample_statistics(seconds);
  }
}

}  // namespace tunica::comparison
