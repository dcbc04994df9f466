// SPDX-License-Identifier: Apache-2.0
#include "comparison/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "numerics/distributions.hpp"

namespace tunica::comparison {

namespace {

Box box_of(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const auto quantile = [&](double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
  };
  return {sorted.front(), quantile(0.25), quantile(0.5), quantile(0.75), sorted.back()};
}

}  // namespace

SampleStatistics sample_statistics(std::span<const double> values) {
  SampleStatistics result;
  result.count = values.size();
  if (values.empty()) return result;
  const double n = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / n;
  result.box = box_of(values);
  if (values.size() < 2) return result;
  double squares = 0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  const double sd = std::sqrt(squares / (n - 1));
  const double half = numerics::student_quantile(0.975, n - 1) * sd / std::sqrt(n);
  result.sd = sd;
  result.ci95 = {result.mean - half, result.mean + half};
  return result;
}

Interval wilson_interval(std::size_t successes, std::size_t trials) {
  if (trials == 0) return {0, 1};
  const double n = static_cast<double>(trials), p = static_cast<double>(successes) / n;
  const double z = numerics::normal_quantile(0.975);
  const double centre = p + z * z / (2 * n), half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  const double scale = 1 + z * z / n;
  // At 0 and n successes one end is 0 or 1 exactly; rounding must not push it out.
  return {successes == 0 ? 0 : (centre - half) / scale, successes == trials ? 1 : (centre + half) / scale};
}

double success_threshold(std::optional<double> target, double best_known) {
  return target ? *target : best_known + 1e-3 * std::abs(best_known) + 1e-12;
}

}  // namespace tunica::comparison
