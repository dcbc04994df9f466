// SPDX-License-Identifier: Apache-2.0
#include "elastic.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "curve.hpp"
#include "tunica/detail/safeguarded_newton.hpp"

namespace tunica::thick_wall {
namespace {

constexpr int newton_iterations = 8;
constexpr double quadrature_error = 1e-12, tolerable_error = 1e-7;  ///< of y = ln ri

/// A step that may be left to first order: it leaves a residual pressure of about (step p_y/p)²/2 relative to p, p
/// growing exponentially in y. 1e-6 squared is well below 1e-10; where p vanishes p_y takes its place.
bool small(double step, double p, double p_y) { return std::abs(step) * p_y < 1e-6 * (std::abs(p) + 0.01 * p_y); }

void take(Row& row, const WallForces& forces, const Wall& wall) {
  row.forces = forces;
  double p = forces.p;
  if (row.support_free > 0) {
    p += support(wall, row.y, row.axial_stretch, row.support_free);
    row.forces.p_y += support_slope(wall, row.y, row.axial_stretch);
  }
  row.step = (row.pressure - p) / row.forces.p_y;
}

Status evaluate(std::vector<Row>& rows, bool parameters, Sections& sections, const Wall& wall) {
  thread_local std::vector<Section> batch;
  batch.clear();
  for (const Row& row : rows) batch.push_back({row.axial_stretch, row.y});
  Status status = sections.evaluate(batch, parameters);
  for (std::size_t i = 0; i < rows.size() && status.ok(); ++i) take(rows[i], sections.forces(i), wall);
  return status;
}

/// The next rule to try after number k: errors fall geometrically with the number of points.
std::size_t finer(std::span<const Rule> all, std::size_t k, double error) {
  const double points = static_cast<double>(all[k].node.size());
  const double wanted = error < 0.1 ? points * std::log(quadrature_error) / std::log(error) : 2 * points;
  std::size_t next = k + 1;
  while (next + 1 < all.size() && static_cast<double>(all[next].node.size()) < wanted) ++next;
  return next;
}

/// One row alone, inside a bracket around its start.
bool rescue(Row& row, Sections& sections, const Wall& wall) {
  return detail::safeguarded_newton(
      [&](double y) {
        const Section section{row.axial_stretch, y};
        if (!sections.evaluate({&section, 1}, false).ok())
          return detail::Residual{std::numeric_limits<double>::quiet_NaN(), 0};
        Row trial = row;
        trial.y = y;
        take(trial, sections.forces(0), wall);
        return detail::Residual{-trial.step * trial.forces.p_y, trial.forces.p_y};
      },
      row.y);
}

void note_error(const std::vector<Row>& rows, const Sections& sections, double& error) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    error = std::max(error, sections.pressure_error(i) / rows[i].forces.p_y);
}

/// Newton's method on all rows until every step may be left to first order.
Status polish(std::vector<Row>& rows, Sections& sections, const Wall& wall, double& error) {
  thread_local std::vector<double> start;
  start.clear();
  for (const Row& row : rows) start.push_back(row.y);
  const auto done = [](const Row& row) { return row.forces.p_y > 0 && small(row.step, row.pressure, row.forces.p_y); };
  for (int iteration = 0; iteration < newton_iterations; ++iteration) {
    if (Status status = evaluate(rows, false, sections, wall); !status.ok()) return status;
    if (std::all_of(rows.begin(), rows.end(), done)) {
      note_error(rows, sections, error);
      return Status();
    }
    for (Row& row : rows)
      if (std::abs(row.step) < 1) row.y += std::clamp(row.step, -0.05, 0.05);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (done(rows[i])) continue;
    rows[i].y = start[i];
    if (!rescue(rows[i], sections, wall))
      return Status::failed("thick_wall_pressurisation: Newton's method finds no equilibrium at " +
                            TubeRows::row_name(i, rows[i].pressure, rows[i].axial_stretch));
  }
  Status status = evaluate(rows, false, sections, wall);
  note_error(rows, sections, error);
  return status;
}

/// The unpressurised states first: where there is support, rows refer to them.
Status polish_all(bool want_free_rows, Sections& sections, const Wall& wall, Solution& solution) {
  if (want_free_rows || wall.tether != 0) {
    if (Status status = polish(solution.free_rows, sections, wall, solution.error); !status.ok()) return status;
    for (Row& row : solution.rows) {
      const Row& without = solution.free_rows[row.free_row];
      if (wall.tether != 0) row.support_free = outer_radius(wall, without.y + without.step, without.axial_stretch);
    }
  }
  return polish(solution.rows, sections, wall, solution.error);
}

/// Starts of all rows from the curve at their one axial stretch, and the unpressurised state there; false = they have
/// to be followed.
bool on_curve(Path& path, Equilibrium free, std::span<const double> pressure, std::span<const double> axial_stretch,
              Sections& sections, Solution& solution) {
  thread_local std::vector<double> y;
  const std::size_t n = pressure.size();
  const double lz = axial_stretch[0];
  if (n < fewest_on_curve ||
      std::any_of(axial_stretch.begin(), axial_stretch.end(), [lz](double l) { return l != lz; }))
    return false;
  y.resize(n);
  if (!path.follow(free, lz, 0).ok() || !find_on_curve(free, pressure, sections, y, solution.error)) {
    solution.error = 0;
    return false;
  }
  solution.free_rows.push_back({.axial_stretch = lz, .pressure = 0, .y = free.y});
  for (std::size_t i = 0; i < n; ++i)
    solution.rows.push_back({.axial_stretch = lz, .pressure = pressure[i], .y = y[i], .step = 0, .free_row = 0});
  return true;
}

}  // namespace

Status evaluate_rows(std::vector<Row>& rows, bool parameters, Sections& sections, const Wall& wall) {
  for (Row& row : rows) row.y += row.step;
  return evaluate(rows, parameters, sections, wall);
}

Status solve_rows(std::span<const double> pressure, std::span<const double> axial_stretch, bool want_free_rows,
                  Sections& sections, const Wall& wall, double enough, Solution& solution) {
  const bool supported = wall.tether != 0;
  solution.rows.clear();
  solution.free_rows.clear();
  solution.error = 0;
  Path path(sections, wall);
  Equilibrium free, at;  // the unpressurised state, and the one of the row
  Status status = path.begin(free);
  if (status.ok() && !supported && on_curve(path, free, pressure, axial_stretch, sections, solution)) {
    if (solution.error > enough) return {};
    if (polish_all(want_free_rows, sections, wall, solution).ok()) return {};
    solution.rows.clear();
    solution.free_rows.clear();
    solution.error = 0;
  }
  for (std::size_t i = 0; i < pressure.size() && status.ok(); ++i) {
    const double lz = axial_stretch[i], p = pressure[i];
    if (i == 0 || lz != axial_stretch[i - 1]) {
      if (i == 0 || want_free_rows || supported) {
        status = path.follow(free, lz, 0);
        solution.free_rows.push_back({.axial_stretch = lz, .pressure = 0, .y = free.y});
        if (i == 0 || supported) at = free;
      }
    }
    const double support_free = supported ? outer_radius(wall, free.y, lz) : 0;
    if (status.ok()) status = path.follow(at, lz, p, support_free);
    if (!status.ok())
      return Status::failed(fmt::format("thick_wall_pressurisation: no equilibrium at {}: {}",
                                        TubeRows::row_name(i, p, lz), status.reason()));
    solution.rows.push_back({.axial_stretch = lz, .pressure = p, .y = at.y});
    solution.rows.back().free_row = solution.free_rows.size() - 1;
  }
  if (!status.ok())
    return Status::failed(fmt::format("thick_wall_pressurisation: no equilibrium at {}: {}",
                                      TubeRows::row_name(0, pressure[0], axial_stretch[0]), status.reason()));
  return polish_all(want_free_rows, sections, wall, solution);
}

Status refine_rows(bool want_free_rows, Sections& sections, const Wall& wall, Solution& solution) {
  solution.error = 0;
  for (auto* rows : {&solution.free_rows, &solution.rows})
    for (Row& row : *rows) {
      row.y += row.step;
      row.step = 0;
    }
  return polish_all(want_free_rows, sections, wall, solution);
}

double channel_value(Channel channel, const Wall& wall, const Row& row) {
  const double y = row.y + row.step, ro = outer_radius(wall, y, row.axial_stretch);
  switch (channel) {
    case Channel::outer_diameter:
      return 2 * ro;
    case Channel::inner_diameter:
      return 2 * std::exp(y);
    case Channel::outer_diameter_stretch:
      return ro / wall.Ro;
    case Channel::inner_diameter_stretch:
      return std::exp(y) / wall.Ri;
    case Channel::axial_force:
      break;
  }
  // The support presses on the outer face: F_reduced = F_wall − π p_o ro².
  const double F = row.forces.F + row.forces.F_y * row.step;
  if (row.support_free == 0) return F;
  return F - std::numbers::pi * support(wall, y, row.axial_stretch, row.support_free) * ro * ro;
}

Status prescribed(const Tube& tube, const TestInput& input, std::vector<double>& pressure,
                  std::vector<double>& axial_stretch) {
  return tube.prescribed(input, input.test_parameters[axial_stretch_error], pressure, axial_stretch);
}

Status write_rows(const Tube& tube, const Wall& wall, std::span<const Row> rows, const TestOutput& output) {
  const std::size_t n = rows.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Row& row = rows[i];
    const double F = channel_value(Channel::axial_force, wall, row);
    if (!std::isfinite(F) || !std::isfinite(row.y + row.step))
      return Status::failed("thick_wall_pressurisation: the stress overflows at " +
                            TubeRows::row_name(i, row.pressure, row.axial_stretch));
    for (std::size_t k = 0; k < tube.channels.size() && !output.values.empty(); ++k)
      output.values[k * n + i] =
          tube.channels[k] == Channel::axial_force ? F : channel_value(tube.channels[k], wall, row);
    if (output.diagnostics.empty()) continue;
    // Mean stresses from equilibrium of half a ring and of a cross-section.
    const double ri = inner_radius(row), ro = outer_radius(wall, row.y + row.step, row.axial_stretch);
    const double outside =
        row.support_free > 0 ? support(wall, row.y + row.step, row.axial_stretch, row.support_free) : 0;
    output.diagnostics[i] = ri / wall.Ri;
    output.diagnostics[n + i] = (row.pressure * ri - outside * ro) / (ro - ri);
    output.diagnostics[2 * n + i] =
        (F + std::numbers::pi * row.pressure * ri * ri) / (std::numbers::pi * (ro * ro - ri * ri));
  }
  return {};
}

Status predict_elastic(const Tube& tube, const Rule* rule, const TestInput& input, const TestOutput& output) {
  thread_local Sections sections;
  thread_local Solution solution;
  thread_local SectorDerivative sector;
  thread_local std::vector<double> pressure, axial_stretch;
  const bool derivatives = !output.jacobian.empty() || !output.abscissa_derivative.empty();
  const bool parameters = !output.jacobian.empty();
  Wall wall(tube, input.test_parameters);
  const Layers layers(input);
  if (Status status = prescribed(tube, input, pressure, axial_stretch); !status.ok()) return status;
  const auto solve = [&](const Rule& with, double enough, bool from_found) {
    wall = Wall(tube, input.test_parameters);
    Status status = close_sector(tube, layers, with, sections, wall, parameters ? &sector : nullptr);
    if (!status.ok()) return status;
    sections.begin(layers, wall, with);
    if (from_found && refine_rows(parameters, sections, wall, solution).ok()) return Status();
    return solve_rows(pressure, axial_stretch, parameters, sections, wall, enough, solution);
  };
  constexpr double any = std::numeric_limits<double>::infinity();
  if (rule != nullptr) {
    if (Status status = solve(*rule, any, false); !status.ok()) return status;
  } else {
    // From the coarsest on; a failure counts where a fine rule confirms it.
    const std::span<const Rule> all = rules();
    constexpr std::size_t confirming = 7;
    bool found = false;
    for (std::size_t k = 0; k < all.size();) {
      Status status = solve(all[k], k + 1 < all.size() ? quadrature_error : any, found);
      found = status.ok();
      if (status.ok() && solution.error <= quadrature_error) break;
      if (!status.ok() && k >= confirming) return status;
      if (status.ok() && k + 1 == all.size() && solution.error > tolerable_error)
        return Status::failed(
            "thick_wall_pressurisation: the stress varies too sharply through the wall to integrate it, "
            "within row 1 to " +
            std::to_string(pressure.size()));
      k = status.ok() ? finer(all, k, solution.error) : confirming;
    }
  }
  if (derivatives) {
    Status status = differentiate(tube, wall, sector, solution, sections, input.model_parameters.size(),
                                  output.jacobian, output.abscissa_derivative);
    if (!status.ok()) return status;
  }
  return write_rows(tube, wall, solution.rows, output);
}

}  // namespace tunica::thick_wall
