// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "posterior/counter_random.hpp"
#include "posterior/target.hpp"

namespace tunica::posterior {

/// A step along the difference of two earlier points a, b of the chain, z' = z + γ (a − b), accepted by Metropolis:
/// it has the shape of the posterior as a whole. Tangent moves are steps of the density near z, and stay long where
/// bounds bend it, in its tails. γ = 2.38/√(2 n), and 1 in one step of ten.
///
/// Sources: C. J. F. ter Braak, Stat. Comput. 16:239 (2006); points of the past, C. J. F. ter Braak, J. A. Vrugt, Stat.
/// Comput. 18:435 (2008). `past` must not change once draws count: the step is then a random walk, and keeps the
/// posterior as it is.
///
/// Moves `here`, or leaves it. One simulation.
void make_difference_move(Target& target, Point& here, std::span<const Eigen::VectorXd> past, CounterRandom& random);

}  // namespace tunica::posterior
