// SPDX-License-Identifier: Apache-2.0
#include "curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tunica::fe {

Chebyshev::Chebyshev(double low, double high, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const double x = -std::cos(static_cast<double>(k) * std::numbers::pi / static_cast<double>(count - 1));
    points_.push_back(0.5 * (low + high) + 0.5 * (high - low) * x);
  }
  points_.front() = low;
  points_.back() = high;
}

void Chebyshev::weights(double x, std::span<double> weights) const {
  const auto hit = std::find(points_.begin(), points_.end(), x);
  if (hit != points_.end()) {
    std::fill(weights.begin(), weights.end(), 0.0);
    weights[static_cast<std::size_t>(hit - points_.begin())] = 1;
    return;
  }
  double sum = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const double end = k == 0 || k + 1 == points_.size() ? 0.5 : 1;
    weights[k] = end * (k % 2 == 0 ? 1 : -1) / (x - points_[k]);
    sum += weights[k];
  }
  for (double& weight : weights) weight /= sum;
}

double Chebyshev::tail(std::span<const double> values) const {
  const std::size_t n = values.size();
  double largest = 0;
  for (std::size_t m = n - std::min<std::size_t>(n, 3); m < n; ++m) {
    double a = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const double end = k == 0 || k + 1 == n ? 0.5 : 1;
      a += end * values[k] *
           std::cos(static_cast<double>(m * (n - 1 - k)) * std::numbers::pi / static_cast<double>(n - 1));
    }
    largest = std::max(largest, std::abs(a) * 2 / static_cast<double>(n - 1));
  }
  return largest;
}

}  // namespace tunica::fe
