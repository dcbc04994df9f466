// SPDX-License-Identifier: Apache-2.0
#include "assembly/parameter_id.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace tunica::assembly {

namespace {

template <class Entry>
Entry& named(std::vector<Entry>& entries, const std::string& name) {
  const auto found = std::ranges::find(entries, name, [](const Entry& entry) { return entry.name; });
  if (found == entries.end()) throw std::logic_error(fmt::format("the experiment has no '{}'", name));
  return *found;
}

template <class Entry>
experiment::ParameterSettings& settings_of(Entry& entry, const std::string& mechanism) {
  if (mechanism.empty()) return entry.parameters;
  const auto found = std::ranges::find(entry.mechanisms, mechanism, &experiment::MechanismEntry::name);
  if (found == entry.mechanisms.end())
    throw std::logic_error(fmt::format("'{}' has no mechanism '{}'", entry.name, mechanism));
  return found->parameters;
}

}  // namespace

experiment::ParameterSetting& setting_at(experiment::Experiment& experiment, const ParameterId& id) {
  switch (id.kind) {
    case ParameterId::Owner::model:
      return settings_of(named(experiment.models, id.owner), id.mechanism)[id.name];
    case ParameterId::Owner::test:
      return settings_of(named(experiment.tests, id.owner), id.mechanism)[id.name];
    case ParameterId::Owner::state:
      break;
  }
  return named(experiment.states, id.owner).differs[id.name];
}

}  // namespace tunica::assembly
