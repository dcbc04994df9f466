// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulation.hpp"

namespace tunica::fe {

/// What is observed at each load of a wall that remembers: row by row in loading order, each point with the state that
/// the row before has left and, where there is a clock, the time between them in s. A row is one step of the material;
/// load steps within it find its equilibrium and leave nothing behind. Ends that are held after stretching, and the
/// support, begin at equilibrium. `support` and `failed_at` are those of Simulation::run.
Status follow_history(Simulation& simulation, Material& material, std::span<const Load> loads,
                      std::span<const double> time, double support, std::vector<Sample>& samples,
                      std::size_t& failed_at);

}  // namespace tunica::fe
