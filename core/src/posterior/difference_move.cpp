// SPDX-License-Identifier: Apache-2.0
#include "posterior/difference_move.hpp"

#include <cmath>
#include <utility>

namespace tunica::posterior {

void make_difference_move(Target& target, Point& here, std::span<const Eigen::VectorXd> past, CounterRandom& random) {
  constexpr double share_of_whole_steps = 0.1;
  const auto any = [&]() -> const Eigen::VectorXd& {
    return past[static_cast<std::size_t>(random.uniform() * static_cast<double>(past.size()))];
  };
  const Eigen::VectorXd& a = any();
  const Eigen::VectorXd& b = any();
  const bool whole = random.uniform() < share_of_whole_steps;
  const double chance = random.uniform();
  const double factor = whole ? 1 : 2.38 / std::sqrt(2 * static_cast<double>(here.z.size()));
  Point there;
  if (!target.evaluate(here.z + factor * (a - b), there)) return;
  // p(z')/p(z)
  if (chance < std::exp(there.log_density - here.log_density)) std::swap(here, there);
}

}  // namespace tunica::posterior
