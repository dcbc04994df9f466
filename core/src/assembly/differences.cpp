// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "assembly/evaluator.hpp"
#include "assembly/objective.hpp"
#include "assembly/run_test.hpp"
#include "assembly/secant.hpp"
#include "assembly/workspace.hpp"
#include "plugins/calls.hpp"

namespace tunica::assembly {
namespace {

/// Central differences balance truncation h²f''' against rounding εf/h at h ~ ε^(1/3), measured on the scale over
/// which the parameter matters: its own size, for a linear scale at least a hundredth of its range.
double step_length(double value, const FreeParameter& parameter) {
  const double h = std::cbrt(std::numeric_limits<double>::epsilon()) * parameter_scale(value, parameter);
  return std::min(h, 0.25 * (parameter.max - parameter.min));
}

}  // namespace

Status Evaluator::difference_as_stated(const RunTest& test, std::span<const double> at, std::span<const double> values,
                                       Workspace& workspace) const {
  const Differencing& stated = *test.test->describe().differencing;
  const std::size_t size = test.size(), count = test.columns.size();
  SecantPoint* const point = stated.updates && workspace.secant != nullptr
                                 ? &workspace.secant->tests[static_cast<std::size_t>(&test - tests_.data())]
                                 : nullptr;
  // Rows of differenced tests stand in the order of the columns.
  const std::span<double> rows(workspace.jacobian.data(), count * size);
  double cost = 0;
  for (std::size_t k = 0; point != nullptr && k < fitted_.size(); ++k)
    if (&tests_[fitted_[k].test] == &test)
      cost += channel_cost(fitted_[k], workspace.measured.empty() ? fitted_[k].measured : workspace.measured[k],
                           workspace.predictions, {});
  if (point != nullptr && update_secant(*point, test, layout_.parameters, at, values, cost)) {
    std::copy(point->jacobian.begin(), point->jacobian.end(), rows.begin());
    return {};
  }
  std::vector<Status> statuses(count);
  const plugins::Clock::time_point deadline = plugins::deadline_of_this_thread();
  const auto column_of = [&](std::size_t number) {
    const plugins::Call part{nullptr, "evaluation", nullptr, nullptr, deadline};
    const plugins::CallScope scope(part);
    const auto& [index, row] = test.columns[number];
    const FreeParameter& parameter = layout_.parameters[index];
    const WorkspacePointer own = make_workspace();
    std::vector<double> shifted(at.begin(), at.end()), ahead(size), behind(values.begin(), values.end());
    const double h =
        std::min(stated.step * parameter_scale(at[index], parameter), 0.25 * (parameter.max - parameter.min));
    const auto predict_at = [&, index = index](double offset, std::vector<double>& into) {
      shifted[index] = at[index] + offset;
      return call(test, shifted, into, {}, *own);
    };
    const bool room_above = at[index] + h <= parameter.max, room_below = at[index] - h >= parameter.min;
    Status up, down;
    const bool above = room_above && (up = predict_at(h, ahead)).ok();
    bool below = false;
    if ((stated.central || !above) && room_below) below = (down = predict_at(-h, behind)).ok();
    if (!above && !below) {
      statuses[number] = Status::failed(fmt::format("test '{}': no differences by '{}' at {:.6g}: {}", test.name,
                                                    parameter.name, at[index], up.ok() ? down.reason() : up.reason()));
      return;
    }
    if (!above) std::copy(values.begin(), values.end(), ahead.begin());
    if (!below) std::copy(values.begin(), values.end(), behind.begin());
    const double width = above && below ? 2 * h : h;
    for (std::size_t i = 0; i < size; ++i) rows[row * size + i] = (ahead[i] - behind[i]) / width;
  };
  // Isolated: a thread that waits for a simulation must not begin another search in between.
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(std::size_t{0}, count, column_of, tbb::simple_partitioner()); });
  for (Status& status : statuses)
    if (!status.ok()) return std::move(status);
  if (point != nullptr)
    *point = {{at.begin(), at.end()},
              {values.begin(), values.end()},
              {rows.begin(), rows.end()},
              0,
              point->at.empty() ? cost : std::min(cost, point->least)};
  return {};
}

Status Evaluator::difference(const RunTest& test, std::span<const double> at, std::span<const double> values,
                             Workspace& workspace) const {
  if (test.test->describe().differencing) return difference_as_stated(test, at, values, workspace);
  const std::size_t size = test.size();
  const std::span<double> ahead(workspace.ahead.data(), size), behind(workspace.behind.data(), size);
  std::vector<double>& shifted = workspace.shifted;
  std::copy(at.begin(), at.end(), shifted.begin());
  for (const auto& [index, row] : test.columns) {
    const FreeParameter& parameter = layout_.parameters[index];
    const double value = at[index], h = step_length(value, parameter);
    const auto predict_at = [&, index = index](double offset, std::span<double> into) {
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
