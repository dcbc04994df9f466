// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <boost/math/special_functions/legendre.hpp>

namespace tunica::thick_wall {

/// The Gauss–Legendre rule on [0, 1], and what it says of its own error.
///
/// From the same samples come the last two Legendre coefficients a of the integrand. Coefficients of a smooth function
/// fall geometrically, a_m ~ ρ^−m, and the rule's error is of the order of a_2n ~ a²/M, M the mean of |f|.
struct Rule {
  std::vector<double> node, weight;
  std::vector<double> last, last_but_one;  ///< (2m + 1) w P_m, m = n − 1 and n − 2: a_m by a scalar product

  explicit Rule(int points) {
    for (const double x : boost::math::legendre_p_zeros<double>(points)) {  // not negative, the smallest first
      const double slope = boost::math::legendre_p_prime(points, x), w = 1 / ((1 - x * x) * slope * slope);
      node.push_back(0.5 * (1 + x));
      weight.push_back(w);
      if (x == 0) continue;
      node.insert(node.begin(), 0.5 * (1 - x));
      weight.insert(weight.begin(), w);
    }
    for (std::size_t k = 0; k < node.size(); ++k) {
      const double x = 2 * node[k] - 1;
      last.push_back((2 * points - 1) * weight[k] * boost::math::legendre_p(points - 1, x));
      last_but_one.push_back((2 * points - 3) * weight[k] * boost::math::legendre_p(points - 2, x));
    }
  }

  /// Estimate of the error of Σ w f, for f at the nodes.
  [[nodiscard]] double error(const double* f) const {
    double mean = 0, a = 0, b = 0;
    for (std::size_t k = 0; k < node.size(); ++k) {
      mean += weight[k] * std::abs(f[k]);
      a += last[k] * f[k];
      b += last_but_one[k] * f[k];
    }
    const double largest = std::max(std::abs(a), std::abs(b));
    return largest == 0 ? 0 : largest * std::min(1., largest / mean);
  }
};

/// Rules to choose from, one finer than the other.
std::span<const Rule> rules();

}  // namespace tunica::thick_wall
