// SPDX-License-Identifier: Apache-2.0
#include "assembly/states.hpp"

#include <algorithm>

namespace tunica::assembly {
namespace {

using experiment::ParameterSetting;

/// The parameter's setting in the state; keys that the state lacks come from the setting in the model.
ParameterSetting together(const ParameterSetting& in_state, const Slot& slot) {
  ParameterSetting all = in_state;
  if (all.fixed) return all;
  const Parameter& declared = slot.declaration;
  const ParameterSetting none, &of_model = slot.setting ? *slot.setting : none;
  all.own_initial = in_state.initial.has_value();
  all.min = in_state.min.value_or(of_model.min.value_or(declared.min));
  all.max = in_state.max.value_or(of_model.max.value_or(declared.max));
  if (!all.scale) all.scale = of_model.scale.value_or(declared.scale);
  if (!all.initial) all.initial = of_model.initial.value_or(of_model.fixed.value_or(declared.initial));
  // If the state's bounds exclude the model's initial value, that value is not the user's choice.
  if (!all.own_initial && *all.min < *all.max) all.initial = std::clamp(*all.initial, *all.min, *all.max);
  return all;
}

/// The names that a state may use for a parameter of a model. The name with the model's name takes precedence.
std::vector<std::string> names_of(const std::string& parameter, const std::string& model) {
  const std::string prefix = model + ".";
  if (parameter.starts_with(prefix)) return {parameter, parameter.substr(prefix.size())};
  return {prefix + parameter, parameter};
}

}  // namespace

std::vector<Slot> slots_in(const experiment::StateEntry& state, const std::string& model, const std::vector<Slot>& bare,
                           std::size_t owner, std::deque<ParameterSetting>& settings, std::vector<Differing>& differing,
                           std::set<std::string>& unread) {
  std::vector<Slot> slots = bare;
  for (std::size_t position = 0; position < slots.size(); ++position) {
    Slot& slot = slots[position];
    const ParameterSetting* own = nullptr;
    std::string key;  // as the state's entry has it
    for (const std::string& name : names_of(slot.declaration.name, model)) {
      const auto found = state.differs.find(name);
      if (found == state.differs.end()) continue;
      unread.erase(name);
      if (own != nullptr) continue;
      own = &found->second;
      key = name;
    }
    if (own == nullptr) {
      slot.same_as = {owner, position};
      continue;
    }
    slot.setting = &settings.emplace_back(together(*own, slot));
    differing.push_back({state.name, slot.declaration.name, state.name + "." + slot.declaration.name});
    slot.declaration.name = differing.back().own;
    slot.id = {ParameterId::Owner::state, state.name, "", key};
  }
  return slots;
}

}  // namespace tunica::assembly
