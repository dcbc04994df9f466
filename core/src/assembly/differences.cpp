// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "assembly/evaluator.hpp"
#include "assembly/objective.hpp"
#include "assembly/run_test.hpp"
#include "assembly/workspace.hpp"

namespace tunica::assembly {
namespace {

/// Central differences balance truncation h²f''' against rounding εf/h at h ~ ε^(1/3), measured on the scale over
/// which the parameter matters: its own size, for a linear scale at least a hundredth of its range.
double step_length(double value, const FreeParameter& parameter) {
  double scale = std::abs(value);
  if (parameter.scale == Scale::linear) scale = std::max(scale, 0.01 * (parameter.max - parameter.min));
  const double h = std::cbrt(std::numeric_limits<double>::epsilon()) * scale;
  return std::min(h, 0.25 * (parameter.max - parameter.min));
}

}  // namespace

Status Evaluator::difference(const RunTest& test, std::span<const double> at, std::span<const double> values,
                             Workspace& workspace) const {
  const std::size_t size = test.size();
  const std::span<double> ahead(workspace.ahead.data(), size), behind(workspace.behind.data(), size);
  std::vector<double>& shifted = workspace.shifted;
  std::copy(at.begin(), at.end(), shifted.begin());
  for (const auto& [index, row] : test.columns) {
    const FreeParameter& parameter = layout_.parameters[index];
    const double value = at[index], h = step_length(value, parameter);
    const auto predict_at = [&](double offset, std::span<double> into) {
      shifted[index] = value + offset;
      Status status = call(test, shifted, into, {}, workspace);
      shifted[index] = value;
      return status;
    };
    double* const column = &workspace.jacobian[row * size];
    // f' ≈ (f(+h) − f(−h))/2h inside; (4f(±h) − 3f − f(±2h))/(±2h) where one side lies beyond a bound or fails.
    Status up, down;
    const bool above = value + h <= parameter.max && (up = predict_at(h, ahead)).ok();
    const bool below = value - h >= parameter.min && (down = predict_at(-h, behind)).ok();
    if (above && below) {
      for (std::size_t i = 0; i < size; ++i) column[i] = (ahead[i] - behind[i]) / (2 * h);
      continue;
    }
    const double side = above ? h : -h;
    const std::span<double> near = above ? ahead : behind, far = above ? behind : ahead;
    Status status = above || below ? predict_at(2 * side, far) : up.ok() ? down : up;
    if (!status.ok()) {
      return Status::failed(fmt::format("test '{}': no differences by '{}' at {:.6g}: {}", test.name, parameter.name,
                                        value, status.reason()));
    }
    for (std::size_t i = 0; i < size; ++i) column[i] = (4 * near[i] - 3 * values[i] - far[i]) / (2 * side);
  }
  return {};
}

}  // namespace tunica::assembly
