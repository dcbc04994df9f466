// SPDX-License-Identifier: Apache-2.0
#include "comparison/statistics.hpp"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace tunica::comparison {

SampleStatistics sample_statistics(std::span<const double> values) {
  SampleStatistics result;
  result.count = values.size();
  if (values.empty()) return result;
  const double n = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / n;
  if (values.size() < 2) return result;
  double squares = 0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  const double sd = std::sqrt(squares / (n - 1));
  const double half = boost::math::quantile(boost::math::students_t(n - 1), 0.975) * sd / std::sqrt(n);
  result.sd = sd;
  result.ci95 = {result.mean - half, result.mean + half};
  return result;
}

double success_threshold(std::optional<double> target, double best_known) {
  return target ? *target : best_known + 1e-3 * std::abs(best_known) + 1e-12;
}

}  // namespace tunica::comparison
