// SPDX-License-Identifier: Apache-2.0
#include "population/power.hpp"

#include <cmath>

#include <boost/math/distributions/non_central_t.hpp>

#include "numerics/distributions.hpp"

namespace tunica::population {

namespace {
constexpr double wanted_power = 0.8;
constexpr std::size_t most_specimens = 10000;
}  // namespace

double power(double difference, double variance, double specimens) {
  const double freedom = 2 * (specimens - 1);
  const double shift = std::abs(difference) / std::sqrt(2 * variance / specimens);
  if (shift > 30) return 1;  // the distribution cannot be told from a point
  const boost::math::non_central_t_distribution<double> distribution(freedom, shift);
  const double threshold = numerics::student_quantile(0.975, freedom);
  return boost::math::cdf(boost::math::complement(distribution, threshold)) +
         boost::math::cdf(distribution, -threshold);
}

std::optional<std::size_t> specimens_needed(double difference, double variance) {
  if (power(difference, variance, static_cast<double>(most_specimens)) < wanted_power) return {};
  std::size_t too_few = 1, enough = most_specimens;
  while (enough - too_few > 1) {
    const std::size_t middle = (too_few + enough) / 2;
    (power(difference, variance, static_cast<double>(middle)) < wanted_power ? too_few : enough) = middle;
  }
  return enough;
}

double detectable_difference(double variance, double specimens) {
  double none = 0, enough = std::sqrt(variance);
  while (power(enough, variance, specimens) < wanted_power) enough *= 2;
  for (int step = 0; step < 50; ++step) {
    const double middle = 0.5 * (none + enough);
    (power(middle, variance, specimens) < wanted_power ? none : enough) = middle;
  }
  return enough;
}

}  // namespace tunica::population
