// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/hypotheses/extension.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "diagnosis/hypotheses/places.hpp"
#include "plugins/default_options.hpp"
#include "plugins/guarded.hpp"

namespace tunica::diagnosis {
namespace {

using experiment::Experiment;
using experiment::MechanismEntry;

/// Defaults of its options, with what the addition says: number options of the setting, channel and row of the place.
/// The bounds of an amplitude whose size depends on the specimen are written down with it.
MechanismEntry entry_of(const Addition& addition, const MechanismFactory& mechanism) {
  MechanismEntry entry{addition.id, {}, {}, addition.as};
  if (addition.range) {
    const AmplitudeRange& range = *addition.range;
    experiment::ParameterSetting& amplitude = entry.parameters[mechanism.parameters.front().name];
    amplitude.min = range.min;
    amplitude.max = range.max;
    amplitude.initial = std::clamp(0.1 * range.plausible_max + 0.9 * mechanism.null, range.min, range.max);
  }
  entry.options = plugins::default_options(mechanism.options);
  for (const Option& option : mechanism.options) {
    if (option.name == "channel") entry.options.set("channel", addition.place.channel);
    if (option.name == "rows" && addition.place.row)
      entry.options.set("rows", fmt::format("{}:{}:1", *addition.place.row, *addition.place.row + 1));
    for (const auto& [name, value] : addition.setting)
      if (name == option.name) entry.options.set(name, value);
  }
  return entry;
}

template <class Entries>
auto& entry_named(Entries& entries, const std::string& name) {
  return *std::find_if(entries.begin(), entries.end(), [&name](const auto& entry) { return entry.name == name; });
}

/// A mechanism that is there already, in the base or before it among the additions, gets a name of its own.
void name_apart(const Experiment& experiment, const std::string& model, Addition& addition) {
  const auto taken = [&](const std::string& name) {
    const auto has = [&](const std::vector<MechanismEntry>& entries) {
      return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) { return entry.name() == name; });
    };
    if (addition.place.tests.empty()) return has(experiment.model(model).mechanisms);
    return std::any_of(addition.place.tests.begin(), addition.place.tests.end(),
                       [&](const std::string& test) { return has(experiment.test(test).mechanisms); });
  };
  for (int number = 2; taken(addition.name()); ++number) addition.as = fmt::format("{}_{}", addition.id, number);
}

/// A clock for the tests of a run that have none and whose pace is open.
void set_pace(Experiment& experiment, const experiment::RunEntry& run, double pace,
              const plugins::Catalogue& catalogue) {
  for (const std::string& name : run.tests) {
    experiment::TestEntry& entry = entry_named(experiment.tests, name);
    data::Dataset timed =
        data::read_dataset(entry.data, catalogue.tests().find(entry.type)->second.factory.observables);
    if (!pace_is_open(entry, timed)) continue;
    for (std::size_t i = 0; i < timed.count; ++i) timed.time.push_back(pace * static_cast<double>(i));
    entry.data.given = std::make_shared<const data::Dataset>(std::move(timed));
    entry.data.sorted = false;
  }
}

}  // namespace

Extension::Extension(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                     std::vector<Addition> additions, const plugins::Catalogue& catalogue)
    : experiment_(experiment), additions_(std::move(additions)) {
  const std::vector<std::string> models = experiment_.models_of(run);
  const auto model_of = [&models](const Addition& addition) {
    return addition.place.model.empty() ? models.front() : addition.place.model;
  };
  for (Addition& addition : additions_) {
    const MechanismFactory& mechanism = catalogue.mechanisms().at(addition.id).factory;
    const std::string model = model_of(addition);
    name_apart(experiment_, model, addition);
    if (addition.place.tests.empty())
      entry_named(experiment_.models, model).mechanisms.push_back(entry_of(addition, mechanism));
    for (const std::string& test : addition.place.tests)
      entry_named(experiment_.tests, test).mechanisms.push_back(entry_of(addition, mechanism));
  }
  // A test was pulled at one pace. The first mechanism that needs a clock says at which.
  const auto clocked = [&](const Addition& one) { return needs_clock(catalogue.mechanisms().at(one.id).factory); };
  const auto first = std::find_if(additions_.begin(), additions_.end(), clocked);
  if (first != additions_.end()) {
    const std::optional<double> pace = first->pace;
    for (Addition& one : additions_)
      if (clocked(one)) one.pace = pace;
    if (pace) set_pace(experiment_, run, *pace, catalogue);
  }
  assembly_ = std::make_unique<assembly::Assembly>(experiment_, run, catalogue);

  std::vector<bool> added(assembly_->layout().parameters.size(), false);
  for (const Addition& addition : additions_) {
    const MechanismFactory& mechanism = catalogue.mechanisms().at(addition.id).factory;
    Part part{{}, {}, {}, mechanism.null};
    for (std::size_t k = 0; k < mechanism.parameters.size(); ++k) {
      Variable variable;
      const auto add = [&](const assembly::ParameterId& id) {
        const auto index = assembly_->layout().index_of(id);
        if (!index)
          throw plugins::PluginFailure(
              fmt::format("the mechanism '{}' declares the parameter '{}' but does not have it", addition.id,
                          mechanism.parameters[k].name));
        variable.push_back(*index);
        added[*index] = true;
      };
      const std::string& name = mechanism.parameters[k].name;
      if (addition.place.tests.empty()) add(assembly::of_model(model_of(addition), addition.name(), name));
      for (const std::string& test : addition.place.tests) add(assembly::of_test(test, addition.name(), name));
      if (k == 0) {
        part.amplitude = std::move(variable);
        continue;
      }
      double start = assembly_->layout().parameters[variable.front()].initial;
      for (const auto& [name, value] : addition.setting)
        if (name == mechanism.parameters[k].name) start = value;
      part.nuisance.push_back(std::move(variable));
      part.nuisance_start.push_back(start);
    }
    parts_.push_back(std::move(part));
  }
  for (std::size_t j = 0; j < added.size(); ++j)
    if (!added[j]) base_.push_back(j);
}

std::vector<double> Extension::at_null(std::span<const double> base) const {
  std::vector<double> free(assembly_->layout().parameters.size());
  for (std::size_t j = 0; j < base_.size(); ++j) free[base_[j]] = base[j];
  for (const Part& part : parts_) {
    for (const std::size_t member : part.amplitude) free[member] = part.null;
    for (std::size_t k = 0; k < part.nuisance.size(); ++k)
      for (const std::size_t member : part.nuisance[k]) {
        const auto& parameter = assembly_->layout().parameters[member];
        free[member] = std::clamp(part.nuisance_start[k], parameter.min, parameter.max);
      }
  }
  return free;
}

std::vector<Variable> Extension::variables(bool with_nuisance) const {
  std::vector<Variable> all;
  for (const std::size_t j : base_) all.push_back({j});
  for (const Part& part : parts_) {
    all.push_back(part.amplitude);
    if (with_nuisance) all.insert(all.end(), part.nuisance.begin(), part.nuisance.end());
  }
  return all;
}

std::string share_of(const Addition& addition, const Parameter& parameter) {
  return addition.name() + "_" + parameter.name;
}

experiment::Experiment with_shares(const Extension& extension, const plugins::Catalogue& catalogue) {
  experiment::Experiment experiment = extension.experiment();
  for (const Addition& addition : extension.additions()) {
    if (addition.place.tests.size() < 2) continue;
    for (const Parameter& parameter : catalogue.mechanisms().at(addition.id).factory.parameters)
      for (const std::string& test : addition.place.tests)
        setting_at(experiment, assembly::of_test(test, addition.name(), parameter.name)).share =
            share_of(addition, parameter);
  }
  return experiment;
}

}  // namespace tunica::diagnosis
