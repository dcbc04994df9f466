// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/output/fitted_experiment.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "plugins/default_options.hpp"

namespace tunica::diagnosis {

using experiment::Experiment;

namespace {

/// The requested optimizer; else Levenberg–Marquardt, which converges at once from the fitted values.
std::string optimizer_of(Experiment& experiment, const std::string& asked, const plugins::Catalogue& catalogue) {
  if (!asked.empty()) return asked;
  const auto* const refiner = catalogue.refiner();
  if (refiner == nullptr) return experiment.runs.empty() ? "" : experiment.runs.front().optimizer;
  for (const experiment::OptimizerEntry& entry : experiment.optimizers)
    if (entry.type == refiner->factory.type) return entry.name;
  experiment::OptimizerEntry entry;
  entry.name = "lm";
  entry.type = refiner->factory.type;
  while (std::any_of(experiment.optimizers.begin(), experiment.optimizers.end(),
                     [&](const auto& other) { return other.name == entry.name; }))
    entry.name += "_extended";
  entry.options = plugins::default_options(refiner->factory.options);
  experiment.optimizers.push_back(std::move(entry));
  return experiment.optimizers.back().name;
}

}  // namespace

Experiment fitted_experiment(Experiment experiment, experiment::RunEntry run, const assembly::Assembly& assembly,
                             std::span<const double> free, const std::string& optimizer,
                             const plugins::Catalogue& catalogue) {
  for (std::size_t j = 0; j < assembly.layout().parameters.size(); ++j)
    for (const assembly::ParameterId& place : assembly.layout().parameters[j].places)
      setting_at(experiment, place).initial = free[j];
  for (auto& test : experiment.tests) test.weights.assign(test.data.noise.size(), 1.0);
  run.optimizer = optimizer_of(experiment, optimizer, catalogue);
  if (!experiment.runs.empty()) run.stop = experiment.runs.front().stop;
  experiment.runs = {run};
  experiment.name += "_extended";
  return experiment;
}

}  // namespace tunica::diagnosis
