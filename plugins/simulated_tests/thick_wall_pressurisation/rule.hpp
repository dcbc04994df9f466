// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <boost/math/special_functions/legendre.hpp>

namespace tunica::thick_wall {

/// What a smooth function's last Legendre or Chebyshev coefficients say of one as far behind them as they are from the
/// first: coefficients fall geometrically, so it is about last²/mean, with the mean of |f| for the first.
inline double coefficient_behind(double last, double mean) { return last < mean ? last * (last / mean) : last; }

/// The Gauss–Legendre rule on [0, 1], and what it says of its own error.
///
/// From the same samples come the last two Legendre coefficients a of the integrand. A rule of n points leaves an error
/// of the order of a_2n.
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
};

/// Rules to choose from, one finer than the other.
std::span<const Rule> rules();

}  // namespace tunica::thick_wall
