// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "diagnosis/output/outputs.hpp"
#include "experiment/reader.hpp"

namespace tunica::diagnosis {
namespace {

using experiment::Experiment;
using experiment::MechanismEntry;

/// Where the file has the parameter that results call `name`: "mu", "strip.stretch_error", "fibre_dispersion.kappa".
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
  for (const Option& option : catalogue.optimizers().at("ceres_lm").factory.options)
    if (option.fallback) entry.options.set(option.name, *option.fallback);
  experiment.optimizers.push_back(std::move(entry));
  return "lm";
}

/// A run takes rows as the file has them, a diagnosis those of unknown order by their values.
void count_rows_as_the_file(Experiment& experiment, const Addition& addition) {
  if (!addition.place.row) return;
  for (auto& test : experiment.tests)
    if (test.name == addition.place.tests.front())
      for (MechanismEntry& entry : test.mechanisms)
        if (entry.name() == addition.name())
          entry.options.set("rows", fmt::format("{}:{}:1", addition.place.file_row, addition.place.file_row + 1));
}

/// A gross row that was left out gets a shift of its own, which leaves it out of a run as well.
void add_gross_rows(Experiment& experiment, const std::vector<Cause>& rows, const plugins::Catalogue& catalogue) {
  for (const Cause& row : rows)
    for (auto& test : experiment.tests) {
      if (test.name != row.place.tests.front()) continue;
      MechanismEntry entry{row.id, {}, {}};
      for (const Option& option : catalogue.mechanisms().at(row.id).factory.options)
        if (option.fallback) entry.options.set(option.name, *option.fallback);
      entry.options.set("channel", row.place.channel);
      entry.options.set("rows", fmt::format("{}:{}:1", row.place.file_row, row.place.file_row + 1));
      experiment::ParameterSetting& shift = entry.parameters[row.amplitude.name];
      shift.initial = row.amplitude.value;
      if (const double wide = 5 * std::abs(row.amplitude.value); wide > 0) {
        shift.min = -wide;
        shift.max = wide;
      }
      test.mechanisms.push_back(std::move(entry));
    }
}

}  // namespace

std::string extended_experiment(const Diagnosis& d, const plugins::Catalogue& catalogue) {
  if (!d.explanation.claim.best) return {};
  const Refit& best = *d.explanation.claim.best;
  Experiment experiment = best.extension->experiment();
  const auto& assembly = best.extension->assembly();
  experiment::RunEntry run = d.analysis.evidence.run;
  const std::vector<std::string> models = experiment.models_of(run);
  for (auto& test : experiment.tests) test.weights.assign(test.data.noise.size(), 1.0);
  // One amplitude in several tests: they share a parameter.
  for (const Addition& addition : best.additions) {
    if (addition.place.tests.size() < 2) continue;
    for (const Parameter& parameter : catalogue.mechanisms().at(addition.id).factory.parameters)
      for (const std::string& test : addition.place.tests)
        if (auto* setting =
                setting_of(experiment, models, fmt::format("{}.{}.{}", test, addition.name(), parameter.name)))
          setting->share = addition.name() + "_" + parameter.name;
  }
  for (const Addition& addition : best.additions) count_rows_as_the_file(experiment, addition);
  add_gross_rows(experiment, d.explanation.left_out, catalogue);
  for (std::size_t j = 0; j < assembly.layout().parameters.size(); ++j) {
    const std::string& name = assembly.layout().parameters[j].name;
    if (auto* setting = setting_of(experiment, models, name))
      setting->initial = best.fit.free[j];
    else
      set_shared(experiment, name, best.fit.free[j]);
  }
  run.optimizer = optimizer_of(experiment, d.request.optimizer, catalogue);
  if (!experiment.runs.empty()) run.stop = experiment.runs.front().stop;
  experiment.runs = {run};
  experiment.name += "_extended";
  return experiment::write_input(experiment, catalogue);
}

}  // namespace tunica::diagnosis
