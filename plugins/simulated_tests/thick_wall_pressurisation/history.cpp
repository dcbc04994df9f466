// SPDX-License-Identifier: Apache-2.0
#include "history.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "memory.hpp"
#include "tunica/detail/safeguarded_newton.hpp"

namespace tunica::thick_wall {
namespace {

constexpr int row_iterations = 8;
constexpr double settled = 1e-9;  ///< of y = ln ri; such a step is applied to first order
constexpr double largest_guess = 0.1;

/// y at which the tube carries the row's pressure, from `row.y`; leaves its forces in the row. Newton's method alone
/// where it contracts from there, else inside a bracket.
bool solve(Row& row, const Memory& memory, Sections& sections, const Wall& wall) {
  const auto evaluate = [&](double y, const Memory& with) {
    const Section section{row.axial_stretch, y};
    const Status status = sections.evaluate({&section, 1}, {}, with);
    row.forces = sections.forces(0);
    return status.ok();
  };
  const auto residual = [&](double y) {
    if (!evaluate(y, {memory.time_step, memory.old_state, {}}))
      return detail::Residual{std::numeric_limits<double>::quiet_NaN(), 0};
    double p = row.forces.p, p_y = row.forces.p_y;
    if (row.support_free > 0) {
      p += support(wall, y, row.axial_stretch, row.support_free);
      p_y += support_slope(wall, y, row.axial_stretch);
    }
    return detail::Residual{p - row.pressure, p_y};
  };
  const double begun = row.y;
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < row_iterations; ++iteration) {
    if (!evaluate(row.y, memory)) break;
    double p = row.forces.p, p_y = row.forces.p_y;
    if (row.support_free > 0) {
      p += support(wall, row.y, row.axial_stretch, row.support_free);
      p_y += support_slope(wall, row.y, row.axial_stretch);
    }
    row.step = (row.pressure - p) / p_y;
    if (!(p_y > 0) || !(std::abs(row.step) < 0.5 * before)) break;
    if (std::abs(row.step) < settled) return true;
    before = std::abs(row.step);
    row.y += row.step;
  }
  row.y = begun;
  row.step = 0;
  return detail::safeguarded_newton(residual, row.y) && evaluate(row.y, memory);
}

}  // namespace

Status predict_with_history(const Tube& tube, const Rule& rule, const TestInput& input, const TestOutput& output) {
  thread_local Sections sections;
  std::vector<double> pressure, axial_stretch;
  Wall wall(tube, input.test_parameters);
  const Layers layers(input);
  const bool followed = !output.jacobian.empty();
  if (Status status = prescribed(tube, input, pressure, axial_stretch); !status.ok()) return status;
  // At equilibrium only the elastic part of a model plays a part.
  SectorDerivative sector;
  const Model& elastic = input.model.elastic();
  const bool in_axes = input.layers.empty() && input.model.describe().axis_history_size > 0;
  const TestInput without_memory{elastic, input.model_parameters.first(elastic.describe().parameters.size()),
                                 input.test_parameters};
  const Layers bare(in_axes ? without_memory : input);
  if (Status status = close_sector(tube, bare, rule, sections, wall, followed ? &sector : nullptr); !status.ok())
    return status;
  sections.begin(layers, wall, rule);
  std::optional<MemoryDerivatives> derivatives;
  if (followed) {
    derivatives.emplace(tube, wall, rule, sector, input);
    if (Status status = derivatives->begin(); !status.ok()) return status;
  }

  const std::size_t n = pressure.size(), points = sections.points_per_section();
  const std::size_t history = layers.history_size(points / layers.size());
  std::vector<double> old_state(history), new_state(history), time_step(points);
  std::vector<Row> rows(n);
  Row free{.axial_stretch = 1, .y = std::log(wall.Ri)};
  double y = free.y, slope = std::numeric_limits<double>::infinity(), pressure_before = 0;
  for (std::size_t i = 0; i < n; ++i) {
    Row& row = rows[i];
    const double before = i == 0 ? 1 : axial_stretch[i - 1];
    row.axial_stretch = axial_stretch[i];
    row.pressure = pressure[i];
    // The bulk of the wall goes with 1/√λz, and along the last tangent.
    const double ahead = (row.pressure - pressure_before) / slope;
    row.y = y - 0.5 * std::log(row.axial_stretch / before) + (std::abs(ahead) < largest_guess ? ahead : 0);
    if (wall.tether != 0) {
      free.y -= 0.5 * std::log(row.axial_stretch / before);
      free.axial_stretch = row.axial_stretch;
      if (!solve(free, {}, sections, wall))
        return Status::failed("thick_wall_pressurisation: no equilibrium without pressure at " +
                              TubeRows::row_name(i, row.pressure, row.axial_stretch));
      row.support_free = outer_radius(wall, free.y + free.step, free.axial_stretch);
    }
    double step = 0;
    if (!tube.time.empty()) step = i == 0 ? std::max(0.0, tube.time[0]) : tube.time[i] - tube.time[i - 1];
    std::fill(time_step.begin(), time_step.end(), step);
    const Memory memory{
        {time_step.data(), tube.time.empty() ? 0 : points}, {old_state.data(), i > 0 ? history : 0}, new_state};
    if (!solve(row, memory, sections, wall))
      return Status::failed("thick_wall_pressurisation: no equilibrium at " +
                            TubeRows::row_name(i, row.pressure, row.axial_stretch) +
                            ": the energy overflows, or the pressure stops rising (limit pressure)");
    std::swap(old_state, new_state);
    y = row.y;
    slope = row.forces.p_y;
    pressure_before = row.pressure;
    if (!derivatives) continue;
    if (Status status = derivatives->add(i, row, step, output.jacobian); !status.ok()) return status;
  }
  return write_rows(tube, wall, rows, output);
}

}  // namespace tunica::thick_wall
