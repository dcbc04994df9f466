// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "assembly/binding.hpp"
#include "assembly/differing.hpp"
#include "experiment/experiment.hpp"

namespace tunica::assembly {

/// The slots of a model in a state: those of the owner number `owner`, `bare`, with its own value where the state says
/// so. What the state leaves open, bounds and scale, are those of the model. `settings` keeps what the file and the
/// model say together, and `differing` gets what differs.
std::vector<Slot> slots_in(const experiment::StateEntry& state, const std::vector<Slot>& bare, std::size_t owner,
                           std::deque<experiment::ParameterSetting>& settings, std::vector<Differing>& differing);

}  // namespace tunica::assembly
