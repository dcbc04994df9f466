// SPDX-License-Identifier: Apache-2.0
#include "comparison/ranking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

namespace tunica::comparison {

namespace {

const char* name_of(experiment::ObjectiveType type) {
  switch (type) {
    case experiment::ObjectiveType::standardised_quadratic:
      return "standardised_quadratic";
    case experiment::ObjectiveType::least_squares:
      return "least_squares";
    case experiment::ObjectiveType::sum_of_norms:
      return "sum_of_norms";
  }
  return "";
}

/// 0: fits and keeps the constraints; 1: breaks one; 2: no result.
int standing(const RunSummary& run) { return !run.has_result ? 2 : run.status.ok() ? 0 : 1; }

}  // namespace

std::string group_of(const experiment::RunEntry& run) {
  return fmt::format("{} on {}", name_of(run.objective), fmt::join(run.tests, ", "));
}

std::vector<Ranked> rank(const std::vector<RunSummary>& runs) {
  std::map<std::string, std::size_t> group_order;
  for (const auto& run : runs) group_order.emplace(run.group, group_order.size());
  std::vector<Ranked> order;
  for (std::size_t run = 0; run < runs.size(); ++run) order.push_back({run, std::nullopt});
  std::stable_sort(order.begin(), order.end(), [&](const Ranked& a, const Ranked& b) {
    const auto key = [&](const RunSummary& run) {
      return std::tuple(group_order.at(run.group), standing(run), run.has_result ? run.objective : 0.0);
    };
    return key(runs[a.run]) < key(runs[b.run]);
  });
  std::map<std::string, std::size_t> next;
  for (auto& entry : order)
    if (runs[entry.run].has_result) entry.rank = ++next[runs[entry.run].group];
  return order;
}

void count_successes(const execution::Plan& plan, const std::vector<execution::RunResult>& results,
                     std::vector<RunSummary>& runs) {
  const auto conditions = [&](std::size_t run) {
    const auto& entry = *plan.runs[run].entry;
    std::string key = entry.model + '\n' + group_of(entry);
    for (const auto& constraint : entry.constraints) key += '\n' + constraint.json;
    return key;
  };
  std::map<std::string, double> best_known;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    auto& best = best_known.emplace(conditions(run), std::numeric_limits<double>::infinity()).first->second;
    for (const auto& realisation : results[run].realisations)
      if (realisation.best.feasible()) best = std::min(best, realisation.best.objective);
  }
  for (std::size_t run = 0; run < runs.size(); ++run) {
    auto& summary = runs[run];
    const auto& realisations = results[run].realisations;
    summary.threshold = success_threshold(plan.runs[run].entry->stop.target, best_known.at(conditions(run)));
    const auto successes = std::count_if(realisations.begin(), realisations.end(), [&](const auto& realisation) {
      return realisation.best.feasible() && realisation.best.objective <= summary.threshold;
    });
    summary.success_rate =
        realisations.empty() ? 0 : static_cast<double>(successes) / static_cast<double>(realisations.size());
  }
}

}  // namespace tunica::comparison
