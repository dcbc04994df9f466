// SPDX-License-Identifier: Apache-2.0
#include "population/readings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "tunica/error.hpp"

namespace tunica::population {
namespace {

struct Known {
  double xi = 0, variance = 0;  ///< variance 0: no value
};

std::vector<Known> known(const Cohort& cohort, const Reading& reading, Parameter& parameter) {
  std::vector<Known> result(reading.values.size());
  std::vector<double> values;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (!reading.values[i]) continue;
    const auto& [value, error] = *reading.values[i];
    if (reading.logarithmic && !(value > 0))
      throw InputError(
          fmt::format("reading '{}' of the specimen '{}' is {}; expected one above 0 for a ratio, or compare "
                      "differences",
                      reading.name, cohort.specimens[i].name, value));
    const double share = reading.logarithmic ? error / value : error;
    result[i] = {reading.logarithmic ? std::log(value) : value, share * share};
    values.push_back(result[i].xi);
  }
  if (values.size() < 2)
    throw InputError(fmt::format("reading '{}' has {} values, expected two specimens at least; leave it out",
                                 reading.name, values.size()));
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  parameter.scale = *high > *low ? *high - *low : std::max(std::abs(*high), 1.0);
  for (std::size_t i = 0; i < result.size(); ++i)
    if (reading.values[i]) result[i].variance = std::max(result[i].variance, std::pow(1e-6 * parameter.scale, 2));
  return result;
}

}  // namespace

Cohort cohort_of_readings(const Cohort& cohort, const std::vector<Reading>& readings) {
  Cohort result;
  result.specimens = cohort.specimens;
  result.factors = cohort.factors;
  result.animals = cohort.animals;
  result.channels = {{"readings", false}};
  result.start.resize(static_cast<Eigen::Index>(readings.size()));
  std::vector<std::vector<Known>> all;
  for (const Reading& reading : readings) {
    Parameter parameter{reading.name, reading.logarithmic, 1};
    all.push_back(known(cohort, reading, parameter));
    double mean = 0, count = 0;
    for (const Known& one : all.back()) {
      if (one.variance == 0) continue;
      mean += one.xi;
      ++count;
    }
    result.start[static_cast<Eigen::Index>(result.parameters.size())] = mean / count;
    result.parameters.push_back(parameter);
  }
  // The readings are quadratics already: any point of expansion is as good as the maximum.
  result.expand = [all = std::move(all)](std::size_t i, const Prior& prior) -> std::optional<Expansion> {
    const auto p = static_cast<Eigen::Index>(all.size());
    Expansion expansion{prior.mean, {{Eigen::MatrixXd::Zero(p, p), Eigen::VectorXd::Zero(p), 0, 0}}, 0};
    Quadratic& own = expansion.channels.front();
    for (Eigen::Index j = 0; j < p; ++j) {
      const Known& one = all[static_cast<std::size_t>(j)][i];
      if (one.variance == 0) continue;
      expansion.point[j] = one.xi;
      own.information(j, j) = 1 / one.variance;
      own.rows += 1;
      expansion.normalisation += std::log(2 * std::numbers::pi * one.variance);
    }
    return expansion;
  };
  return result;
}

}  // namespace tunica::population
