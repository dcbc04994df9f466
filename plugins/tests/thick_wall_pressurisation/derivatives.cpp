// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <numbers>

#include "elastic.hpp"

namespace tunica::thick_wall {
namespace {

/// A change of the geometric variables, and what a parameter changes beside them.
struct Direction {
  std::array<double, variable_count> by{};  ///< of λz, K, V, ι; y follows from equilibrium
  double tether = 0;
  bool model = false, ratio = false;  ///< the material changes: model parameter `parameter`, or the factors of layers
  std::size_t parameter = 0;
};

double along(const Jet& f, const std::array<double, variable_count>& by) {
  double sum = 0;
  for (int k = 0; k < variable_count; ++k) sum += f.v[k] * by[static_cast<std::size_t>(k)];
  return sum;
}

/// One evaluated row as a function of the geometric variables.
struct RowJet {
  Jet p, F, ri, ro;

  static Jet root(const Jet& square) {
    Jet f(std::sqrt(square.a));
    for (int k = 0; k < variable_count; ++k) f.v[k] = square.v[k] / (2 * f.a);
    return f;
  }
  RowJet(const Sections& sections, std::size_t i, const Wall& wall, const Row& row) {
    const WallForcesJet forces = sections.forces_jet(i);
    const Shape<Jet> form = shape_jet(wall, row.y, row.axial_stretch);
    p = forces.p;
    F = forces.F;
    ri = root(form.ri2);
    ro = root(form.ro2);
  }
};

Sections::Change explicitly(const Sections& sections, std::size_t i, const Direction& direction) {
  return direction.model   ? sections.by_parameter(i, direction.parameter)
         : direction.ratio ? sections.by_ratio(i)
                           : Sections::Change{};
}

/// Change of every channel along a direction, in pieces that depend on the row alone.
class RowDerivative {
 public:
  RowDerivative(const Sections& sections, std::size_t i, const Wall& wall, const Row& row)
      : sections_(sections), i_(i), wall_(wall), row_(row), at_(sections, i, wall, row) {}

  /// Solves for dy: 0 = dp(wall) + d[k (ro − r_free)/Ro] − dp. `free` = change of r_free.
  void turn(const Direction& direction, double free, double pressure) {
    by_ = direction.by;
    by_[ln_inner] = 0;
    const Sections::Change material = explicitly(sections_, i_, direction);
    const double k = wall_.tether / wall_.Ro, gained = (at_.ro.a - row_.support_free) / wall_.Ro;
    const double rest = along(at_.p, by_) + material.p - pressure + k * (along(at_.ro, by_) - free) +
                        (direction.tether != 0 ? direction.tether * gained : 0);
    by_[ln_inner] = -rest / (at_.p.v[ln_inner] + k * at_.ro.v[ln_inner]);
    force_ = along(at_.F, by_) + material.F;
    const double outside = k * (at_.ro.a - row_.support_free), ro_change = along(at_.ro, by_);
    const double outside_change = k * (ro_change - free) + direction.tether * gained;
    if (row_.support_free > 0 || direction.tether != 0)
      force_ -= std::numbers::pi * at_.ro.a * (outside_change * at_.ro.a + 2 * outside * ro_change);
  }
  [[nodiscard]] double outer_radius_change() const { return along(at_.ro, by_); }

  [[nodiscard]] double channel(Channel channel) const {
    switch (channel) {
      case Channel::outer_diameter:
        return 2 * along(at_.ro, by_);
      case Channel::inner_diameter:
        return 2 * along(at_.ri, by_);
      case Channel::outer_diameter_stretch:
        return along(at_.ro, by_) / wall_.Ro;
      case Channel::inner_diameter_stretch:  // Ri² = Ro² − V
        return (along(at_.ri, by_) + at_.ri.a * by_[area] / (2 * wall_.Ri * wall_.Ri)) / wall_.Ri;
      case Channel::axial_force:
        break;
    }
    return force_;
  }

 private:
  const Sections& sections_;
  std::size_t i_;
  const Wall& wall_;
  const Row& row_;
  RowJet at_;
  std::array<double, variable_count> by_{};
  double force_ = 0;
};

std::vector<Direction> directions(const Wall& wall, const SectorDerivative& sector, std::size_t model_parameters) {
  std::vector<Direction> all(model_parameters + (wall.layered ? layer_ratio : own_count));
  for (std::size_t j = 0; j < model_parameters; ++j) {
    all[j].model = true;
    all[j].parameter = j;
    all[j].by[ln_sector] = sector.by_parameter[j];
  }
  Direction* const own = all.data() + model_parameters;
  own[opening_angle].by[closing] = wall.closing_by_angle;
  own[opening_angle].by[ln_sector] = sector.by_closing * wall.closing_by_angle;
  own[axial_stretch_error].by[axial] = 1;
  own[tethering].tether = 1;
  own[thickness_error].by[area] = wall.area_by_error;
  own[thickness_error].by[ln_sector] = sector.by_area * wall.area_by_error;
  if (wall.layered) return all;
  own[layer_ratio].ratio = true;
  own[layer_ratio].by[ln_sector] = sector.by_ratio;
  return all;
}

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

Status differentiate(const Tube& tube, const Wall& wall, const SectorDerivative& sector, Solution& solution,
                     Sections& sections, std::size_t model_parameters, std::span<double> jacobian,
                     std::span<double> abscissa_derivative) {
  const std::size_t n = solution.rows.size(), rows = tube.channels.size() * n;
  const bool parameters = !jacobian.empty(), free_rows = parameters || wall.tether != 0;
  std::vector<Direction> all = parameters ? directions(wall, sector, model_parameters) : std::vector<Direction>();
  const std::size_t by_axial = all.size();  // one more, for the abscissa
  all.emplace_back().by[axial] = 1;

  // How the unpressurised outer radii change.
  std::vector<double> free(all.size() * solution.free_rows.size(), 0.0);
  if (free_rows) {
    if (Status status = evaluate_rows(solution.free_rows, parameters, sections, wall); !status.ok()) return status;
    for (std::size_t i = 0; i < solution.free_rows.size(); ++i) {
      Wall bare = wall;
      bare.tether = 0;
      RowDerivative row(sections, i, bare, solution.free_rows[i]);
      for (std::size_t j = 0; j < all.size(); ++j) {
        Direction direction = all[j];
        direction.tether = 0;
        row.turn(direction, 0, 0);
        free[i * all.size() + j] = row.outer_radius_change();
      }
    }
  }

  if (Status status = evaluate_rows(solution.rows, parameters, sections, wall); !status.ok()) return status;
  for (std::size_t i = 0; i < n; ++i) {
    Row& row = solution.rows[i];
    Row seen = row;  // the change by k needs the unpressurised radius also where k = 0
    if (free_rows) {
      const Row& without = solution.free_rows[row.free_row];
      seen.support_free = outer_radius(wall, without.y + without.step, without.axial_stretch);
    }
    RowDerivative derivative(sections, i, wall, seen);
    const auto write = [&](std::span<double> column) {
      for (std::size_t k = 0; k < tube.channels.size(); ++k) column[k * n + i] = derivative.channel(tube.channels[k]);
    };
    const double* const free_of_row = free.data() + row.free_row * all.size();
    for (std::size_t j = 0; j < by_axial; ++j) {
      derivative.turn(all[j], free_of_row[j], 0);
      write(jacobian.subspan(j * rows, rows));
    }
    if (abscissa_derivative.empty()) continue;
    derivative.turn({}, 0, 1);
    write(abscissa_derivative.subspan(tube.pressure_column * rows, rows));
    if (!tube.stretch_varies) continue;
    derivative.turn(all[by_axial], free_of_row[by_axial], 0);
    write(abscissa_derivative.subspan(tube.stretch_column * rows, rows));
  }
  if (!all_finite(jacobian) || !all_finite(abscissa_derivative))
    return Status::failed("thick_wall_pressurisation: a derivative overflows, within " +
                          TubeRows::row_name(n - 1, solution.rows[n - 1].pressure, solution.rows[n - 1].axial_stretch));
  return {};
}

}  // namespace tunica::thick_wall
