// SPDX-License-Identifier: Apache-2.0
#include "comparison/estimate.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tunica::comparison {

namespace {

/// Share of the search range, in the coordinate the optimiser sees, within which a value counts as being on a bound.
constexpr double on_bound = 1e-6;

/// The best point once more, with a workspace that has seen nothing else. A search that starts from the solution
/// before may end a solver a few roundings elsewhere, no further.
void evaluate_again(const calibration::Assembly& assembly, const execution::RealisationResult& best,
                    RunSummary& summary, std::vector<std::string>& warnings) {
  auto workspace = assembly.make_workspace();
  summary.per_test.resize(summary.tests.size());
  double objective = 0;
  summary.status = assembly.evaluate(best.best.parameters, objective, summary.per_test, {}, {}, *workspace);
  if (summary.status.kind() == Status::Kind::failed) {
    warnings.push_back(
        fmt::format("{}: the best point could not be evaluated again: {}", summary.label, summary.status.reason()));
    return;
  }
  if (std::abs(objective - best.best.objective) > 1e-9 * std::abs(best.best.objective) + 1e-12)
    warnings.push_back(
        fmt::format("{}: the best point gives the objective {} where the search recorded {}: model or test do "
                    "not give the same answer twice",
                    summary.label, objective, best.best.objective));
}

void add_parameters(const calibration::Assembly& assembly, const execution::RealisationResult& best,
                    const execution::RunResult& all, RunSummary& summary) {
  const auto& declared = assembly.parameters();
  const auto& values = best.best.parameters;
  std::vector<double> unit(values.size());
  assembly.to_unit(values, unit);
  for (std::size_t j = 0; j < declared.size(); ++j) {
    Estimate estimate{
        declared[j].name, declared[j].unit, values[j], declared[j].min, declared[j].max, {}, Estimate::Bound::none, {}};
    if (unit[j] <= on_bound) estimate.at_bound = Estimate::Bound::lower;
    if (unit[j] >= 1 - on_bound) estimate.at_bound = Estimate::Bound::upper;
    std::vector<double> sample;
    for (const auto& realisation : all.realisations)
      if (!realisation.best.parameters.empty()) sample.push_back(realisation.best.parameters[j]);
    estimate.over_realisations = sample_statistics(sample);
    summary.parameters.push_back(std::move(estimate));
  }
}

}  // namespace

void estimate(const calibration::Assembly& assembly, const execution::RealisationResult& best,
              const execution::RunResult& all, RunSummary& summary, std::vector<std::string>& warnings) {
  evaluate_again(assembly, best, summary, warnings);
  add_parameters(assembly, best, all, summary);
  summary.identifiability = identifiability_of(assembly, best.best.parameters);
}

std::vector<std::string> identifiability_of(const calibration::Assembly&, std::span<const double>) { return {}; }

}  // namespace tunica::comparison
