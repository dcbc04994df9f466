// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <set>
#include <string>
#include <vector>

#include "assembly/binding.hpp"
#include "assembly/differing.hpp"
#include "experiment/experiment.hpp"

namespace tunica::assembly {

/// The slots of the model called `model` in a state. They are the slots `bare` of owner number `owner`, with separate
/// values for the parameters that the state names, with or without the model's name. Bounds and scale that the state
/// omits are those of the model. `settings` keeps the merged settings of file and model, and `differing` receives the
/// parameters that differ. Names in the state that match a parameter of this model are removed from `unread`.
std::vector<Slot> slots_in(const experiment::StateEntry& state, const std::string& model, const std::vector<Slot>& bare,
                           std::size_t owner, std::deque<experiment::ParameterSetting>& settings,
                           std::vector<Differing>& differing, std::set<std::string>& unread);

}  // namespace tunica::assembly
