// SPDX-License-Identifier: Apache-2.0
#include "elastic.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "curve.hpp"
#include "tunica/detail/safeguarded_newton.hpp"
#include "tunica/detail/vector_math.hpp"

namespace tunica::thick_wall {
namespace {

constexpr int newton_iterations = 8;
constexpr std::size_t confirming = 7;                               ///< of the rules: one so fine that a failure counts
constexpr double quadrature_error = 1e-12, tolerable_error = 1e-7;  ///< of y = ln ri
constexpr double derivative_error = 1e-9;                           ///< of y, where derivatives are taken
constexpr double interpolation_error = 1e-12;                       ///< of y: a curve that need not be looked at again
constexpr double force_error = 1e-11;                               ///< of the largest force

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

Status evaluate(std::vector<Row>& rows, const Sections::Wants& wants, Sections& sections, const Wall& wall) {
  thread_local std::vector<Section> batch;
  batch.clear();
  for (const Row& row : rows) batch.push_back({row.axial_stretch, row.y});
  Status status = sections.evaluate(batch, wants);
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
        if (!sections.evaluate({&section, 1}, {}).ok())
          return detail::Residual{std::numeric_limits<double>::quiet_NaN(), 0};
        Row trial = row;
        trial.y = y;
        take(trial, sections.forces(0), wall);
        return detail::Residual{-trial.step * trial.forces.p_y, trial.forces.p_y};
      },
      row.y);
}

/// Newton's method on all rows until every step may be left to first order.
Status polish(std::vector<Row>& rows, bool force, Sections& sections, const Wall& wall, double& error) {
  const Sections::Wants wants{.geometry = false, .force = force};
  thread_local std::vector<double> start;
  start.clear();
  for (const Row& row : rows) start.push_back(row.y);
  const auto done = [](const Row& row) { return row.forces.p_y > 0 && small(row.step, row.pressure, row.forces.p_y); };
  for (int iteration = 0; iteration < newton_iterations; ++iteration) {
    if (Status status = evaluate(rows, wants, sections, wall); !status.ok()) return status;
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
  Status status = evaluate(rows, wants, sections, wall);
  note_error(rows, sections, error);
  return status;
}

/// The unpressurised states first: where there is support, rows refer to them.
Status polish_all(bool want_free_rows, Sections& sections, const Wall& wall, Solution& solution) {
  if (want_free_rows || wall.tether != 0) {
    if (Status status = polish(solution.free_rows, false, sections, wall, solution.error); !status.ok()) return status;
    for (Row& row : solution.rows) {
      const Row& without = solution.free_rows[row.free_row];
      if (wall.tether != 0) row.support_free = outer_radius(wall, without.y + without.step, without.axial_stretch);
    }
  }
  return polish(solution.rows, solution.force, sections, wall, solution.error);
}

/// All rows from the curve at their one axial stretch, and the unpressurised state there; false = they have to be
/// followed. Where the curve says that it is exact, `exact`, nothing is left to be done; else rows begin there.
bool on_curve(std::span<const double> pressure, std::span<const double> axial_stretch, Sections& sections,
              const Wall& wall, Solution& solution, bool& exact) {
  thread_local std::vector<double> wanted, y, force;
  const std::size_t n = pressure.size();
  const double lz = axial_stretch[0];
  if (n < fewest_on_curve ||
      std::any_of(axial_stretch.begin(), axial_stretch.end(), [lz](double l) { return l != lz; }))
    return false;
  wanted.assign(1, 0);  // the unpressurised state
  wanted.insert(wanted.end(), pressure.begin(), pressure.end());
  y.resize(n + 1);
  force.resize(solution.force ? n + 1 : 0);
  CurveError error;
  if (!find_on_curve(lz, wanted, wall, sections, y, force, error)) return false;
  solution.error = error.quadrature;
  exact = error.interpolation < interpolation_error && error.force < force_error;
  solution.free_rows.assign(1, {.axial_stretch = lz, .pressure = 0, .y = y[0]});
  solution.rows.assign(n, {.axial_stretch = lz});
  for (std::size_t i = 0; i < n; ++i) {
    solution.rows[i].pressure = pressure[i];
    solution.rows[i].y = y[i + 1];
    if (solution.force) solution.rows[i].forces.F = force[i + 1];
  }
  return true;
}

}  // namespace

void note_error(const std::vector<Row>& rows, Sections& sections, double& error) {
  const std::span<const double> errors = sections.pressure_errors();
  for (std::size_t i = 0; i < rows.size(); ++i) error = std::max(error, errors[i] / rows[i].forces.p_y);
}

Status evaluate_rows(std::vector<Row>& rows, const Sections::Wants& wants, Sections& sections, const Wall& wall) {
  for (Row& row : rows) row.y += row.step;
  return evaluate(rows, wants, sections, wall);
}

Status solve_rows(std::span<const double> pressure, std::span<const double> axial_stretch, bool want_free_rows,
                  Sections& sections, const Wall& wall, double enough, Solution& solution) {
  const bool supported = wall.tether != 0;
  solution.rows.clear();
  solution.free_rows.clear();
  solution.error = 0;
  bool exact = false;
  if (!supported && on_curve(pressure, axial_stretch, sections, wall, solution, exact)) {
    if (solution.error > enough || exact) return {};
    if (polish_all(want_free_rows, sections, wall, solution).ok()) return {};
    solution.rows.clear();
    solution.free_rows.clear();
    solution.error = 0;
  }
  // Rows only begin where the path leads to.
  const Rule& rule = sections.rule();
  if (rule.node.size() < rules()[confirming].node.size() && rule.node.size() > rules().front().node.size())
    sections.take(rules().front());
  Path path(sections, wall);
  Equilibrium free, at;  // the unpressurised state, and the one of the row
  Status status = path.begin(free);
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
  sections.take(rule);
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

Status prescribed(const Tube& tube, const TestInput& input, std::vector<double>& pressure,
                  std::vector<double>& axial_stretch) {
  return tube.prescribed(input, input.test_parameters[axial_stretch_error], pressure, axial_stretch);
}

Status write_rows(const Tube& tube, const Wall& wall, std::span<const Row> rows, const TestOutput& output) {
  thread_local std::vector<double> radii;
  const std::size_t n = rows.size();
  radii.resize(2 * n);
  double* const ri = radii.data();
  double* const ro = ri + n;
  detail::vectorised([ri, ro, n, V = wall.V, row = rows.data()] {
    for (std::size_t i = 0; i < n; ++i) {
      ri[i] = row[i].y + row[i].step;
      ro[i] = row[i].axial_stretch;
    }
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) {
      ri[i] = detail::lane_exp(ri[i]);
      ro[i] = std::sqrt(ri[i] * ri[i] + V / ro[i]);
    }
  });
  // The support presses on the outer face: F_reduced = F_wall − π p_o ro².
  const auto outside = [&](std::size_t i) {
    return rows[i].support_free > 0 ? wall.tether * (ro[i] - rows[i].support_free) / wall.Ro : 0;
  };
  const auto force = [&](std::size_t i) {
    return rows[i].forces.F + rows[i].forces.F_y * rows[i].step - std::numbers::pi * outside(i) * ro[i] * ro[i];
  };
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(ri[i]) || !std::isfinite(rows[i].forces.F) || !std::isfinite(rows[i].forces.F_y))
      return Status::failed("thick_wall_pressurisation: the stress overflows at " +
                            TubeRows::row_name(i, rows[i].pressure, rows[i].axial_stretch));
  for (std::size_t k = 0; k < tube.channels.size() && !output.values.empty(); ++k) {
    double* const to = output.values.data() + k * n;
    const auto scaled = [&](const double* radius, double factor) {
      for (std::size_t i = 0; i < n; ++i) to[i] = factor * radius[i];
    };
    switch (tube.channels[k]) {
      case Channel::outer_diameter:
        scaled(ro, 2);
        break;
      case Channel::inner_diameter:
        scaled(ri, 2);
        break;
      case Channel::outer_diameter_stretch:
        scaled(ro, 1 / wall.Ro);
        break;
      case Channel::inner_diameter_stretch:
        scaled(ri, 1 / wall.Ri);
        break;
      case Channel::axial_force:
        for (std::size_t i = 0; i < n; ++i) to[i] = force(i);
    }
  }
  if (output.diagnostics.empty()) return {};
  // Mean stresses from equilibrium of half a ring and of a cross-section.
  for (std::size_t i = 0; i < n; ++i) {
    output.diagnostics[i] = ri[i] / wall.Ri;
    output.diagnostics[n + i] = (rows[i].pressure * ri[i] - outside(i) * ro[i]) / (ro[i] - ri[i]);
    output.diagnostics[2 * n + i] = (force(i) + std::numbers::pi * rows[i].pressure * ri[i] * ri[i]) /
                                    (std::numbers::pi * (ro[i] * ro[i] - ri[i] * ri[i]));
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
  // One wall where its two layers are alike.
  const bool whole = rule == nullptr && !wall.layered && wall.inner == wall.outer;
  solution.force = !output.diagnostics.empty() || std::ranges::count(tube.channels, Channel::axial_force) > 0;
  const auto solve = [&](const Rule& with, double enough, bool from_found) {
    wall = Wall(tube, input.test_parameters);
    Status status = close_sector(tube, layers, with, sections, wall, parameters ? &sector : nullptr);
    if (!status.ok()) return status;
    sections.begin(layers, wall, with, whole);
    if (from_found && refine_rows(parameters, sections, wall, solution).ok()) return Status();
    return solve_rows(pressure, axial_stretch, parameters, sections, wall, enough, solution);
  };
  constexpr double any = std::numeric_limits<double>::infinity();
  const std::span<const Rule> all = rules();
  const auto too_sharp = [&] {
    return Status::failed(
        "thick_wall_pressurisation: the stress varies too sharply through the wall to integrate it, "
        "within row 1 to " +
        std::to_string(pressure.size()));
  };
  std::size_t k = whole ? 3 : 2;  // good enough for most walls
  for (bool found = false; rule == nullptr;) {
    const bool finest = k + 1 == all.size();
    Status status = solve(all[k], finest ? any : quadrature_error, found);
    found = status.ok();
    if (!found && k >= confirming) return status;
    if (found && solution.error <= (finest ? tolerable_error : quadrature_error)) break;
    if (found && finest) return too_sharp();
    k = found ? finer(all, k, solution.error) : confirming;
  }
  if (rule != nullptr)
    if (Status status = solve(*rule, any, false); !status.ok()) return status;
  // Before derivatives evaluate the rows anew, maybe less exactly: values are the same with a Jacobian and without.
  Status status = write_rows(tube, wall, solution.rows, output);
  if (!derivatives || !status.ok()) return status;

  const bool in_layers = whole && parameters;
  // Each layer is half as thick as the whole. Its rule has as many points all the same: at the null of a mechanism the
  // values do not show how steep its slope is.
  if (in_layers) sections.begin(layers, wall, all[k]);
  const auto differentiated = [&] {
    status = differentiate(tube, wall, sector, solution, sections, input.model_parameters.size(), output.jacobian,
                           output.abscissa_derivative);
    return status.ok();
  };
  while (differentiated() && in_layers) {
    const bool finest = k + 1 == all.size();
    if (solution.error <= (finest ? tolerable_error : derivative_error)) break;
    if (finest) return too_sharp();
    sections.begin(layers, wall, all[++k]);
  }
  return status;
}

}  // namespace tunica::thick_wall
