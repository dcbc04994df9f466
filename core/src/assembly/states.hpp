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

/// The slots of the model called `model` in a state: those of the owner number `owner`, `bare`, with its own value
/// where the state says so, with the model's name or without it. What the state leaves open, bounds and scale, are
/// those of the model. `settings` keeps what the file and the model say together, and `differing` gets what differs.
/// Names of the state that are of a parameter of this model leave `unread`.
std::vector<Slot> slots_in(const experiment::StateEntry& state, const std::string& model, const std::vector<Slot>& bare,
                           std::size_t owner, std::deque<experiment::ParameterSetting>& settings,
                           std::vector<Differing>& differing, std::set<std::string>& unread);

}  // namespace tunica::assembly
