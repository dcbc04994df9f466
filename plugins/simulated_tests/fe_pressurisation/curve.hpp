// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace tunica::fe {

/// Chebyshev's points of the second kind, x_k = cos(kπ/(n − 1)), on [low, high] in ascending order: a smooth curve is
/// known everywhere from a few of them, its error falling geometrically with their number.
/// Source: L. N. Trefethen, Approximation Theory and Approximation Practice, SIAM (2013), chapters 2 to 8.
class Chebyshev {
 public:
  Chebyshev(double low, double high, std::size_t count);

  [[nodiscard]] std::span<const double> points() const { return points_; }
  /// Weights of the values at the points that give the interpolant at x (barycentric formula).
  void weights(double x, std::span<double> weights) const;
  /// The largest of the last three Chebyshev coefficients: the order of the interpolant's error.
  [[nodiscard]] double tail(std::span<const double> values) const;

 private:
  std::vector<double> points_;
};

}  // namespace tunica::fe
