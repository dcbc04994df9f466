// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/output/fitted_experiment.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "plugins/default_options.hpp"

namespace tunica::diagnosis {

using experiment::Experiment;
using experiment::MechanismEntry;

experiment::ParameterSetting* setting_of(Experiment& experiment, const std::vector<std::string>& models,
                                         const std::string& name) {
  const auto in_mechanisms = [](std::vector<MechanismEntry>& mechanisms,
                                const std::string& rest) -> experiment::ParameterSetting* {
    const auto dot = rest.find('.');
    if (dot == std::string::npos) return nullptr;
    for (MechanismEntry& entry : mechanisms)
      if (entry.name() == rest.substr(0, dot)) return &entry.parameters[rest.substr(dot + 1)];
    return nullptr;
  };
  for (auto& test : experiment.tests) {
    if (!name.starts_with(test.name + ".")) continue;
    const std::string rest = name.substr(test.name.size() + 1);
    if (auto* found = in_mechanisms(test.mechanisms, rest)) return found;
    if (rest.find('.') == std::string::npos) return &test.parameters[rest];
  }
  for (auto& state : experiment.states)
    if (name.starts_with(state.name + "."))
      if (const auto found = state.differs.find(name.substr(state.name.size() + 1)); found != state.differs.end())
        return &found->second;
  for (auto& model : experiment.models) {
    if (std::find(models.begin(), models.end(), model.name) == models.end()) continue;
    std::string rest = name;
    if (models.size() > 1) {
      if (!name.starts_with(model.name + ".")) continue;
      rest = name.substr(model.name.size() + 1);
    }
    if (auto* found = in_mechanisms(model.mechanisms, rest)) return found;
    if (rest.find('.') == std::string::npos) return &model.parameters[rest];
  }
  return nullptr;
}

namespace {

/// Every setting that is shared under this name begins at the value.
void set_shared(Experiment& experiment, const std::string& name, double value) {
  const auto set = [&](experiment::ParameterSettings& settings) {
    for (auto& [key, setting] : settings)
      if (setting.share == name) setting.initial = value;
  };
  for (auto& model : experiment.models) {
    set(model.parameters);
    for (auto& mechanism : model.mechanisms) set(mechanism.parameters);
  }
  for (auto& test : experiment.tests) {
    set(test.parameters);
    for (auto& mechanism : test.mechanisms) set(mechanism.parameters);
  }
}

/// The one that the diagnosis was asked to use; else Levenberg–Marquardt, which from the fitted values is there at
/// once.
std::string optimizer_of(Experiment& experiment, const std::string& asked, const plugins::Catalogue& catalogue) {
  if (!asked.empty()) return asked;
  for (const experiment::OptimizerEntry& entry : experiment.optimizers)
    if (entry.type == "ceres_lm") return entry.name;
  if (!catalogue.optimizers().contains("ceres_lm") && !experiment.runs.empty())
    return experiment.runs.front().optimizer;
  experiment::OptimizerEntry entry;
  entry.name = "lm";
  entry.type = "ceres_lm";
  while (std::any_of(experiment.optimizers.begin(), experiment.optimizers.end(),
                     [&](const auto& other) { return other.name == entry.name; }))
    entry.name += "_extended";
  entry.options = plugins::default_options(catalogue.optimizers().at("ceres_lm").factory.options);
  experiment.optimizers.push_back(std::move(entry));
  return experiment.optimizers.back().name;
}

}  // namespace

Experiment fitted_experiment(Experiment experiment, experiment::RunEntry run, const assembly::Assembly& assembly,
                             std::span<const double> free, const std::string& optimizer,
                             const plugins::Catalogue& catalogue) {
  const std::vector<std::string> models = experiment.models_of(run);
  for (std::size_t j = 0; j < assembly.layout().parameters.size(); ++j) {
    const std::string& name = assembly.layout().parameters[j].name;
    if (auto* setting = setting_of(experiment, models, name))
      setting->initial = free[j];
    else
      set_shared(experiment, name, free[j]);
  }
  for (auto& test : experiment.tests) test.weights.assign(test.data.noise.size(), 1.0);
  run.optimizer = optimizer_of(experiment, optimizer, catalogue);
  if (!experiment.runs.empty()) run.stop = experiment.runs.front().stop;
  experiment.runs = {run};
  experiment.name += "_extended";
  return experiment;
}

}  // namespace tunica::diagnosis
