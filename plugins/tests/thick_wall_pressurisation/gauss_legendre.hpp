// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/math/special_functions/legendre.hpp>

#include <algorithm>
#include <vector>

namespace tunica::thick_wall {

/// The Gauss–Legendre rule on [0, 1].
struct Rule {
  std::vector<double> node, weight;

  explicit Rule(int points) {
    for (const double x : boost::math::legendre_p_zeros<double>(points)) {  // not negative, the smallest first
      const double slope = boost::math::legendre_p_prime(points, x), w = 1 / ((1 - x * x) * slope * slope);
      node.push_back(0.5 * (1 + x)), weight.push_back(w);
      if (x == 0) continue;
      node.insert(node.begin(), 0.5 * (1 - x)), weight.insert(weight.begin(), w);
    }
  }
};

}  // namespace tunica::thick_wall
