// SPDX-License-Identifier: Apache-2.0
#include "data/local_regression.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tunica::data {
namespace {

constexpr std::size_t fewest = 3;  ///< measured values that a point rests on

/// The weights l of one point, and the rows [first, first + size) that they belong to.
struct Weights {
  std::size_t first = 0;
  std::vector<double> l = {};
  [[nodiscard]] double square() const { return std::inner_product(l.begin(), l.end(), l.begin(), 0.0); }
};

double shared(const Weights& a, const Weights& b) {
  double sum = 0;
  for (std::size_t row = std::max(a.first, b.first); row < std::min(a.first + a.l.size(), b.first + b.l.size()); ++row)
    sum += a.l[row - a.first] * b.l[row - b.first];
  return sum;
}

/// `x` rises.
Weights weights_at(const std::vector<double>& x, double t, double reach) {
  auto first = static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), t - reach) - x.begin());
  auto last = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), t + reach) - x.begin());
  while (last - first < std::min(fewest, x.size())) {
    const bool below = first > 0 && (last == x.size() || t - x[first - 1] <= x[last] - t);
    below ? --first : ++last;
  }
  // A little more than the farthest, whose weight would be zero.
  const double h = std::max({reach, 1.001 * std::abs(x[first] - t), 1.001 * std::abs(x[last - 1] - t)});
  Weights weights{first, std::vector<double>(last - first)};
  double s0 = 0, s1 = 0, s2 = 0;
  for (std::size_t row = first; row < last; ++row) {
    const double u = x[row] - t, w = h > 0 ? std::pow(1 - std::pow(std::abs(u) / h, 3), 3) : 1;
    weights.l[row - first] = w;
    s0 += w;
    s1 += w * u;
    s2 += w * u * u;
  }
  const double determinant = s0 * s2 - s1 * s1;
  const bool line = determinant > 1e-12 * s0 * s2;  // otherwise all values stand at one x: their mean
  for (std::size_t row = first; row < last; ++row)
    weights.l[row - first] *= line ? (s2 - s1 * (x[row] - t)) / determinant : 1 / s0;
  return weights;
}

}  // namespace

Smoothed local_regression(std::span<const double> x, std::span<const double> y, std::span<const double> at,
                          double reach) {
  std::vector<std::size_t> order;
  for (std::size_t row = 0; row < x.size(); ++row)
    if (!std::isnan(y[row])) order.push_back(row);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  Smoothed found;
  found.values.assign(at.size(), std::numeric_limits<double>::quiet_NaN());
  if (order.size() < fewest) return found;
  std::vector<double> sorted, measured;
  for (const std::size_t row : order) {
    sorted.push_back(x[row]);
    measured.push_back(y[row]);
  }
  const auto value = [&](const Weights& weights) {
    return std::inner_product(weights.l.begin(), weights.l.end(),
                              measured.begin() + static_cast<std::ptrdiff_t>(weights.first), 0.0);
  };
  double squares = 0, freedom = 0;
  for (std::size_t row = 0; row < sorted.size(); ++row) {
    const Weights weights = weights_at(sorted, sorted[row], reach);
    squares += std::pow(measured[row] - value(weights), 2);
    freedom += 1 - 2 * weights.l[row - weights.first] + weights.square();
  }
  found.scatter = freedom > 1e-6 ? std::sqrt(squares / freedom) : 0;
  double sum = 0, together = 0;
  Weights last;
  for (std::size_t point = 0; point < at.size(); ++point) {
    Weights weights = weights_at(sorted, at[point], reach);
    found.values[point] = value(weights);
    sum += weights.square();
    if (point > 0) together += shared(last, weights) / std::sqrt(last.square() * weights.square());
    last = std::move(weights);
  }
  const auto points = static_cast<double>(at.size());
  found.error = found.scatter * std::sqrt(sum / points);
  if (at.size() > 1) found.correlation = std::clamp(together / (points - 1), 0.0, 0.99);
  return found;
}

}  // namespace tunica::data
