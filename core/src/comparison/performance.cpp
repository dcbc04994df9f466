// SPDX-License-Identifier: Apache-2.0
#include "comparison/performance.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "comparison/success.hpp"

namespace tunica::comparison {

namespace {

/// One run seen from its optimizer.
struct Attempt {
  std::string problem;
  std::size_t run;
};

using Costs = std::vector<std::pair<double, double>>;  ///< cost of a success, its weight

std::vector<std::pair<double, double>> steps_of(Costs costs) {
  std::sort(costs.begin(), costs.end());
  std::vector<std::pair<double, double>> steps;
  double sum = 0;
  for (const auto& [cost, weight] : costs) {
    sum += weight;
    if (!steps.empty() && steps.back().first == cost)
      steps.back().second = sum;
    else
      steps.emplace_back(cost, sum);
  }
  return steps;
}

}  // namespace

Profiles profiles(const execution::Plan& plan, const std::vector<execution::RunResult>& results,
                  const std::vector<RunSummary>& runs) {
  std::map<std::string, double> least;  // expected running time, by problem
  std::map<std::pair<std::string, std::string>, int> occurrences;
  std::vector<std::pair<std::string, std::vector<Attempt>>> optimizers;  // in order of appearance
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const std::string problem = problem_of(*plan.runs[run].entry);
    double& best = least.emplace(problem, std::numeric_limits<double>::infinity()).first->second;
    best = std::min(best, runs[run].expected_running_time.value_or(best));
    const int occurrence = ++occurrences[{problem, runs[run].optimizer}];
    const std::string name =
        occurrence == 1 ? runs[run].optimizer : fmt::format("{}#{}", runs[run].optimizer, occurrence);
    auto found = std::find_if(optimizers.begin(), optimizers.end(), [&](const auto& o) { return o.first == name; });
    if (found == optimizers.end()) found = optimizers.insert(optimizers.end(), {name, {}});
    found->second.push_back({problem, run});
  }
  Profiles result;
  for (const auto& [name, attempts] : optimizers) {
    Costs ratios{{1, 0}}, simplex_gradients;
    for (const auto& [problem, run] : attempts) {
      const auto& realisations = results[run].realisations;
      const double weight = 1 / static_cast<double>(realisations.size() * attempts.size());
      const double unit = static_cast<double>(plan.runs[run].assembly->layout().parameters.size() + 1);
      for (const auto& realisation : realisations) {
        const auto reached = evaluations_to(realisation, runs[run].threshold);
        if (!reached) continue;
        const double cost = static_cast<double>(*reached);
        ratios.emplace_back(std::max(1.0, cost / least.at(problem)), weight);
        simplex_gradients.emplace_back(cost / unit, weight);
      }
    }
    result.performance.push_back({name, attempts.size(), steps_of(std::move(ratios))});
    result.data.push_back({name, attempts.size(), steps_of(std::move(simplex_gradients))});
  }
  return result;
}

}  // namespace tunica::comparison
