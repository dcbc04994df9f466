// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "tunica/energy_part.hpp"

namespace tunica {

/// A response as a free curve: ψ'' is piecewise linear over knots x_1 < … < x_n, so that
///
///     ψ''(x) = Σ_j c_j B_j(x),   ψ'(0) = s,   ψ(0) = 0,
///
/// with B_j the hat function of knot j. For s ≥ 0 and c_j ≥ 0, ψ is convex and grows from the first knot on, and it is
/// linear in its parameters s, c_1 … c_n (kPa). Without a slope of its own s = 0, and the parameters are the c_j.
/// Beyond the knots ψ'' keeps its last value: ψ' goes on in a line.
///
/// Threads: const. Cost: O(n) a point.
class SplineLaw {
 public:
  /// At least two knots, rising, the first 0.
  SplineLaw(std::vector<double> knots, bool has_slope) : knots_(std::move(knots)), first_height_(has_slope ? 1 : 0) {}

  /// The number of the c_j, and the slope where it has one.
  [[nodiscard]] std::size_t parameter_count() const { return knots_.size() + first_height_; }

  /// As EnergyPart::respond(), at the parameters of the law.
  void respond(std::span<const double> p, const ResponseBatch& b) const {
    const std::size_t n = b.x.size();
    for (std::size_t i = 0; i < n; ++i) {
      const double x = b.x[i];
      const double slope = first_height_ == 0 ? 0 : p[0];
      if (!b.value.empty()) b.value[i] = slope * x;
      if (!b.first.empty()) b.first[i] = slope;
      if (!b.second.empty()) b.second[i] = 0;
      if (first_height_ != 0 && !b.value_dp.empty()) b.value_dp[i] = x;
      if (first_height_ != 0 && !b.first_dp.empty()) b.first_dp[i] = 1;
      for (std::size_t j = 0; j < knots_.size(); ++j) {
        const Hat at = hat(j, x);
        const std::size_t own = first_height_ + j;
        const double c = p[own];
        if (!b.value.empty()) b.value[i] += c * at.value;
        if (!b.first.empty()) b.first[i] += c * at.first;
        if (!b.second.empty()) b.second[i] += c * at.second;
        if (!b.value_dp.empty()) b.value_dp[own * n + i] = at.value;
        if (!b.first_dp.empty()) b.first_dp[own * n + i] = at.first;
      }
    }
  }

 private:
  /// B_j, and what it gives when it is integrated once and twice from 0.
  struct Hat {
    double value = 0, first = 0, second = 0;
  };

  /// A straight piece of a hat from `begin` to `end`, with heights `low` and `high`, as far as x has come.
  static void add_piece(double begin, double end, double low, double high, double x, Hat& hat) {
    if (x <= begin) return;
    const double width = end - begin, t = std::min(x, end) - begin, bend = (high - low) / width;
    // ∫ (low + bend t) dt, and its integral; behind the piece the slope stays
    const double first = t * (low + 0.5 * bend * t), value = t * t * (0.5 * low + bend * t / 6);
    hat.value += value + first * (std::max(x, end) - end);
    hat.first += first;
    if (x <= end) hat.second = low + bend * t;
    if (x > end) hat.second = 0;
  }

  [[nodiscard]] Hat hat(std::size_t j, double x) const {
    const std::size_t last = knots_.size() - 1;
    Hat at;
    if (j == 0 && x < 0) return {0.5 * x * x, x, 1};
    if (j > 0) add_piece(knots_[j - 1], knots_[j], 0, 1, x, at);
    if (j < last) add_piece(knots_[j], knots_[j + 1], 1, 0, x, at);
    if (j == last && x > knots_[j]) {
      const double t = x - knots_[j];
      at.value += 0.5 * t * t;
      at.first += t;
      at.second = 1;
    }
    return at;
  }

  std::vector<double> knots_;
  std::size_t first_height_;  ///< of the c_j among the parameters
};

}  // namespace tunica
