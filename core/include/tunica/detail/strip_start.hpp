// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "tunica/detail/vector_level.hpp"
#include "tunica/strip_path.hpp"

namespace tunica::free_strip {

/// The row whose stretch is nearest.
inline std::size_t nearest(std::span<const double> stretch, double wanted) {
  const auto closer = [wanted](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); };
  return static_cast<std::size_t>(std::min_element(stretch.begin(), stretch.end(), closer) - stretch.begin());
}

/// Where the search for the equilibria of given rows begins: they are first solved at a few Chebyshev points of the
/// stretch range, and λ1 u (1 for an isotropic material, smooth in λ1) interpolated to the rows.
class Start {
 public:
  static constexpr std::size_t node_count = 8;  ///< whole vectors on every level

  Start() = default;
  /// Places the nodes and prepares the interpolation, once a test.
  explicit Start(std::span<const double> stretch) {
    const std::size_t n = stretch.size();
    if (n < 2 * node_count) return;
    const auto [low, high] = std::minmax_element(stretch.begin(), stretch.end());
    if (*high - *low < 1e-6) return;
    // Chebyshev points of the first kind and their barycentric weights (Berrut & Trefethen 2004, eq. 5.3)
    std::array<double, node_count> weight;
    for (std::size_t k = 0; k < node_count; ++k) {
      const double angle = (2 * static_cast<double>(k) + 1) / (2 * node_count) * std::numbers::pi;
      nodes_.push_back(0.5 * (*low + *high) - 0.5 * (*high - *low) * std::cos(angle));
      weight[k] = (k % 2 == 0 ? 1 : -1) * std::sin(angle);
    }
    // Between them lie most tissues: λ2 = λ1^−½ is isotropic.
    for (const double power : {-0.75, -1.25})
      for (const double node : nodes_) guesses_.push_back(std::pow(node, power));
    row_stride_ = (n + detail::widest - 1) / detail::widest * detail::widest;
    interpolation_.resize(2 * node_count * row_stride_);
    for (std::size_t i = 0; i < row_stride_; ++i) {
      const double lambda = stretch[std::min(i, n - 1)];
      double sum = 0;
      std::array<double, node_count> term;
      for (std::size_t k = 0; k < node_count; ++k) {
        double distance = lambda - nodes_[k];
        if (std::abs(distance) < 1e-14) distance = 1e-14;
        term[k] = weight[k] / distance;
        sum += term[k];
      }
      // Hermite's interpolation of f = λ1 u from f and ∂f/∂λ1: (1 − 2 (λ − λ_k) L'_k(λ_k)) L_k² and (λ − λ_k) L_k², L_k
      // Lagrange's polynomials. The node's λ1 and the row's own 1/λ1 are folded in.
      for (std::size_t k = 0; k < node_count; ++k) {
        const double lagrange = term[k] / sum, distance = lambda - nodes_[k];
        double slope = 0;
        for (std::size_t j = 0; j < node_count; ++j)
          if (j != k) slope += 1 / (nodes_[k] - nodes_[j]);
        interpolation_[k * row_stride_ + i] = (1 - 2 * distance * slope) * lagrange * lagrange * nodes_[k] / lambda;
        interpolation_[(node_count + k) * row_stride_ + i] = distance * lagrange * lagrange / lambda;
      }
    }
  }

  void set(StripPath& path) const {
    path.nodes = nodes_;
    path.guesses = guesses_;
    path.interpolation = interpolation_;
    path.row_stride = row_stride_;
  }

 private:
  std::vector<double> nodes_;          ///< stretches of the Chebyshev points; empty = too few rows to pay
  std::vector<double> guesses_;        ///< as StripPath::guesses
  std::vector<double> interpolation_;  ///< as StripPath::interpolation
  std::size_t row_stride_ = 0;         ///< rows, filled up to whole vectors
};

}  // namespace tunica::free_strip
