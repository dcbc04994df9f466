// SPDX-License-Identifier: Apache-2.0
#include "assembly/secant.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/layout.hpp"
#include "assembly/run_test.hpp"

namespace tunica::assembly {
namespace {

constexpr double trusted = 0.7;  ///< largest part of a change of the values that an updated Jacobian may miss

/// Channels differ in units, so each is scaled by its own largest value.
double channel_size(std::span<const double> values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest > 0 ? largest : 1;
}

}  // namespace

double parameter_scale(double value, const FreeParameter& parameter) {
  const double size = std::abs(value);
  return parameter.scale == Scale::linear ? std::max(size, 0.01 * (parameter.max - parameter.min)) : size;
}

bool update_secant(SecantPoint& point, const RunTest& test, std::span<const FreeParameter> parameters,
                   std::span<const double> at, std::span<const double> values, double cost) {
  if (point.at.empty()) return false;
  const std::size_t size = test.size(), count = test.columns.size();
  std::vector<double> step(count), weighted(count), missed(values.begin(), values.end());
  double length = 0;  // ΔpᵀWΔp
  for (std::size_t j = 0; j < count; ++j) {
    const std::size_t index = test.columns[j].first;
    const double scale = parameter_scale(point.at[index], parameters[index]);
    step[j] = at[index] - point.at[index];
    weighted[j] = step[j] / (scale * scale);
    length += step[j] * weighted[j];
  }
  for (std::size_t i = 0; i < size; ++i) missed[i] -= point.values[i];
  double change = 0, error = 0;
  std::vector<double> sizes(test.channels);
  for (std::size_t k = 0; k < test.channels; ++k) sizes[k] = channel_size(values.subspan(k * test.rows, test.rows));
  for (std::size_t i = 0; i < size; ++i) change += std::pow(missed[i] / sizes[i / test.rows], 2);
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t i = 0; i < size; ++i) missed[i] -= point.jacobian[j * size + i] * step[j];
  for (std::size_t i = 0; i < size; ++i) error += std::pow(missed[i] / sizes[i / test.rows], 2);
  // Below the step of the differences, changes of the values are only rounding of the simulation.
  const double least = test.test->describe().differencing->step;
  const bool near = length <= least * least;
  if (near) return true;  // the point stays: short steps add up until they are worth an update
  const bool worse = cost > point.least, good = error <= trusted * trusted * change;
  if (!worse && (!good || point.updates >= std::max<std::size_t>(4, 2 * count))) return false;
  if (!good) return true;
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t i = 0; i < size; ++i) point.jacobian[j * size + i] += missed[i] * weighted[j] / length;
  point.at.assign(at.begin(), at.end());
  point.values.assign(values.begin(), values.end());
  point.least = std::min(point.least, cost);
  ++point.updates;
  return true;
}

}  // namespace tunica::assembly
