// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <numbers>

#include "elastic.hpp"
#include "tunica/detail/vector_math.hpp"

namespace tunica::thick_wall {
namespace {

/// A change of the geometric variables, and the other changes by a parameter.
struct Direction {
  std::array<double, variable_count> by{};  ///< of λz, K, V, ι; y follows from equilibrium
  double tether = 0, pressure = 0;
  bool model = false, ratio = false;  ///< the material changes: model parameter `parameter`, or the factors of layers
  std::size_t parameter = 0;
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

/// The derivatives of rows that have just been evaluated, with parameters where directions change the material. One
/// entry a row in everything; lanes run over rows.
class RowDerivatives {
 public:
  RowDerivatives(Sections& sections, const Wall& wall, std::span<const Row> rows, bool parameters, bool force)
      : sections_(sections), wall_(wall), n_(rows.size()), force_(force), numbers_(scratch(number_count * n_)) {
    by_ = sections.by_geometry(force);
    if (parameters) sections.prepare_parameters(force);
    double* const y = number(ri);
    for (std::size_t i = 0; i < n_; ++i) {
      y[i] = rows[i].y;
      number(lz)[i] = rows[i].axial_stretch;
    }
    detail::vectorised([this, n = n_, V = wall.V, k = wall.tether / wall.Ro] {
      double* const ri_of = number(ri);
      double* const ro_of = number(ro);
      double* const half_per_ro = number(per_2ro);
      double* const compliance = number(y_by_p);
      const double* const lz_of = number(lz);
      TUNICA_LANES
      for (std::size_t i = 0; i < n; ++i) {
        ri_of[i] = detail::lane_exp(ri_of[i]);
        ro_of[i] = std::sqrt(ri_of[i] * ri_of[i] + V / lz_of[i]);
        half_per_ro[i] = 0.5 / ro_of[i];
        compliance[i] = 1 / (by_.p[ln_inner][i] + k * ri_of[i] * ri_of[i] / ro_of[i]);
      }
    });
  }

  /// Outer radii that the rows have without pressure, and in turn() how they change: where there is support, or where
  /// a direction brings it.
  [[nodiscard]] std::span<double> support_free() { return {number(free), n_}; }
  [[nodiscard]] std::span<double> support_free_change() { return {number(free_change), n_}; }

  /// Solves for dy: 0 = dp(wall) + d[k (ro − r_free)/Ro] − dp.
  void turn(const Direction& direction) {
    material(direction);
    double* const p = number(p_change);
    double* const F = force_ ? number(F_change) : nullptr;
    for (const Variable of : {axial, closing, area, ln_sector}) add(direction.by[of], of, p, F);
    for (std::size_t i = 0; direction.pressure != 0 && i < n_; ++i) p[i] -= direction.pressure;
    const double by_lz = direction.by[axial], by_V = area_change_ = direction.by[area];
    const double k = wall_.tether / wall_.Ro, gain = direction.tether / wall_.Ro;
    const bool geometric = by_lz != 0 || by_V != 0, supported = k != 0 || gain != 0;
    detail::vectorised([this, p, by_lz, by_V, k, gain, geometric, supported, n = n_, V = wall_.V] {
      const double* const lz_of = number(lz);
      const double* const ri_of = number(ri);
      const double* const ro_of = number(ro);
      const double* const half_per_ro = number(per_2ro);
      const double* const free_of = number(free);
      const double* const free_by = number(free_change);
      const double* const compliance = number(y_by_p);
      double* const dy = number(y_change);
      double* const ri_by = number(ri_change);
      double* const ro_by = number(ro_change);
      double* const outside_by = number(outside_change);
      // ro² = ri² + V/λz
      for (std::size_t i = 0; i < n; ++i) ro_by[i] = 0;
      if (geometric) {
        TUNICA_LANES
        for (std::size_t i = 0; i < n; ++i) ro_by[i] = (by_V - by_lz * V / lz_of[i]) * half_per_ro[i] / lz_of[i];
      }
      if (supported) {
        TUNICA_LANES
        for (std::size_t i = 0; i < n; ++i) {
          outside_by[i] = gain * (ro_of[i] - free_of[i]) - k * free_by[i];
          p[i] += k * ro_by[i] + outside_by[i];
        }
      }
      TUNICA_LANES
      for (std::size_t i = 0; i < n; ++i) {
        dy[i] = -p[i] * compliance[i];
        ri_by[i] = ri_of[i] * dy[i];
        ro_by[i] += 2 * ri_of[i] * half_per_ro[i] * ri_by[i];
      }
    });
    if (!force_) return;
    add_to(F, ln_inner, number(y_change));
    // F = F(wall) − π p_o ro²
    for (std::size_t i = 0; supported && i < n_; ++i) {
      const double ro_i = number(ro)[i], ro_by = number(ro_change)[i], outside = k * (ro_i - number(free)[i]);
      F[i] -= std::numbers::pi * ro_i * ((number(outside_change)[i] + k * ro_by) * ro_i + 2 * outside * ro_by);
    }
  }
  [[nodiscard]] std::span<const double> outer_radius_change() const { return {number(ro_change), n_}; }

  void write(Channel channel, double* to) const {
    const auto scaled = [&](Number of, double factor) {
      for (std::size_t i = 0; i < n_; ++i) to[i] = factor * number(of)[i];
    };
    switch (channel) {
      case Channel::outer_diameter:
        return scaled(ro_change, 2);
      case Channel::inner_diameter:
        return scaled(ri_change, 2);
      case Channel::outer_diameter_stretch:
        return scaled(ro_change, 1 / wall_.Ro);
      case Channel::inner_diameter_stretch:  // Ri² = Ro² − V
        for (std::size_t i = 0; i < n_; ++i)
          to[i] = (number(ri_change)[i] + number(ri)[i] * area_change_ / (2 * wall_.Ri * wall_.Ri)) / wall_.Ri;
        return;
      case Channel::axial_force:
        return scaled(F_change, 1);
    }
  }

 private:
  enum Number : std::size_t {
    lz,
    ri,
    ro,
    per_2ro,
    y_by_p,  // −dy/dp, support included
    free,
    free_change,
    p_change,
    F_change,
    y_change,
    ri_change,
    ro_change,
    outside_change,
    number_count
  };
  [[nodiscard]] double* number(Number of) { return numbers_.data() + of * n_; }
  [[nodiscard]] const double* number(Number of) const { return numbers_.data() + of * n_; }

  static std::vector<double>& scratch(std::size_t size) {
    thread_local std::vector<double> numbers;
    numbers.assign(size, 0);
    return numbers;
  }
  /// Adds the effect of a geometric variable.
  void add(double by, Variable of, double* p, double* F) const {
    if (by == 0) return;
    detail::vectorised([by, p, p_of = by_.p[of], n = n_] {
      TUNICA_LANES
      for (std::size_t i = 0; i < n; ++i) p[i] += by * p_of[i];
    });
    for (std::size_t i = 0; F != nullptr && i < n_; ++i) F[i] += by * by_.F[of][i];
  }
  void add_to(double* F, Variable of, const double* by) const {
    for (std::size_t i = 0; i < n_; ++i) F[i] += by_.F[of][i] * by[i];
  }
  /// The effect of the material alone.
  void material(const Direction& direction) {
    double* const p = number(p_change);
    double* const F = force_ ? number(F_change) : nullptr;
    if (direction.model) return sections_.by_parameter(direction.parameter, p, F);
    if (direction.ratio) return sections_.by_ratio(p, F);
    std::fill_n(p, n_, 0.0);
    if (force_) std::fill_n(F, n_, 0.0);
  }

  Sections& sections_;
  const Wall& wall_;
  std::size_t n_;
  bool force_;
  std::vector<double>& numbers_;  ///< of this thread
  GeometricDerivatives by_;
  double area_change_ = 0;
};

}  // namespace

Status differentiate(const Tube& tube, const Wall& wall, const SectorDerivative& sector, Solution& solution,
                     Sections& sections, std::size_t model_parameters, std::span<double> jacobian,
                     std::span<double> abscissa_derivative) {
  const std::size_t n = solution.rows.size(), rows = tube.channels.size() * n;
  const bool parameters = !jacobian.empty(), supported = wall.tether != 0;
  const bool force = std::ranges::count(tube.channels, Channel::axial_force) > 0;
  std::vector<Direction> all = parameters ? directions(wall, sector, model_parameters) : std::vector<Direction>();
  const std::size_t by_axial = all.size();  // one more, for the abscissa
  all.emplace_back().by[axial] = 1;

  // The change of the unpressurised outer radii; it has no effect without support.
  std::vector<double> free;
  if (supported) {
    if (Status status = evaluate_rows(solution.free_rows, {.parameters = parameters, .force = false}, sections, wall);
        !status.ok())
      return status;
    Wall bare = wall;
    bare.tether = 0;
    RowDerivatives derivatives(sections, bare, solution.free_rows, parameters, false);
    for (Direction direction : all) {
      direction.tether = 0;
      derivatives.turn(direction);
      const std::span<const double> change = derivatives.outer_radius_change();
      free.insert(free.end(), change.begin(), change.end());
    }
  }

  if (Status status = evaluate_rows(solution.rows, {.parameters = parameters, .force = solution.force}, sections, wall);
      !status.ok())
    return status;
  solution.error = 0;
  note_error(solution.rows, sections, solution.error);
  RowDerivatives derivatives(sections, wall, solution.rows, parameters, force);
  for (std::size_t i = 0; (supported || parameters) && i < n; ++i) {
    const Row& without = solution.free_rows[solution.rows[i].free_row];
    derivatives.support_free()[i] = outer_radius(wall, without.y + without.step, without.axial_stretch);
  }
  const auto turn = [&](std::size_t j, std::span<double> column) {
    for (std::size_t i = 0; supported && i < n; ++i)
      derivatives.support_free_change()[i] = free[j * solution.free_rows.size() + solution.rows[i].free_row];
    derivatives.turn(all[j]);
    for (std::size_t k = 0; k < tube.channels.size(); ++k) derivatives.write(tube.channels[k], &column[k * n]);
  };
  for (std::size_t j = 0; j < by_axial; ++j) turn(j, jacobian.subspan(j * rows, rows));
  if (!abscissa_derivative.empty()) {
    if (tube.stretch_varies) turn(by_axial, abscissa_derivative.subspan(tube.stretch_column * rows, rows));
    Direction by_pressure;
    by_pressure.pressure = 1;
    std::ranges::fill(derivatives.support_free_change(), 0.0);
    derivatives.turn(by_pressure);
    for (std::size_t k = 0; k < tube.channels.size(); ++k)
      derivatives.write(tube.channels[k], &abscissa_derivative[tube.pressure_column * rows + k * n]);
  }
  if (!detail::all_finite(jacobian.data(), jacobian.size()) ||
      !detail::all_finite(abscissa_derivative.data(), abscissa_derivative.size()))
    return Status::failed("thick_wall_pressurisation: a derivative overflows, within " +
                          TubeRows::row_name(n - 1, solution.rows[n - 1].pressure, solution.rows[n - 1].axial_stretch));
  return {};
}

}  // namespace tunica::thick_wall
