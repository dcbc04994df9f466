// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "../tube_rows/tube_rows.hpp"
#include "section.hpp"
#include "tunica/detail/elastic_only.hpp"
#include "tunica/plugin.hpp"
#include "twisted_rows.hpp"

namespace tunica::torsion {
namespace {

using Role = Observable::Role;
using Kind = Observable::Kind;
enum Own : std::size_t { axial_stretch_error, thickness_error };

/// A solid cylinder has no thickness.
std::vector<Parameter> own_parameters(bool solid) {
  std::vector<Parameter> all{axial_stretch_error_parameter(), thickness_error_parameter()};
  if (solid) all.pop_back();
  return all;
}

/// A long tube or solid cylinder that is twisted, at prescribed axial stretch and pressure.
class Torsion final : public Test {
 public:
  explicit Torsion(const TestSetup& setup)
      : twisted_(setup), points_(static_cast<int>(setup.options.integer("gauss_points"))) {
    description_.parameters = own_parameters(twisted_.solid());
    description_.nulls.assign(description_.parameters.size(), 0);
    description_.diagnostics = {"inner_radius", "outer_radius", "largest_shear"};
    description_.diagnostic_units = {"mm", "mm", "1"};
    rows_.count = twisted_.count();
    for (std::size_t k = 0; k < twisted_.columns.size(); ++k)
      rows_.abscissae.push_back({twisted_.names[k], twisted_.columns[k]});
    rows_.channels = setup.rows.channels;
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    return twist_with(points_, input, output);
  }

  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override {
    const std::size_t n = rows_.count, size = n * twisted_.channels.size();
    std::vector<double> coarse(size), fine(size);
    if (Status status = twist_with(points_, input, {coarse, {}, {}, {}}); !status.ok()) return status;
    if (Status status = twist_with(2 * points_, input, {fine, {}, {}, {}}); !status.ok()) return status;
    for (std::size_t k = 0; k < twisted_.channels.size(); ++k) {
      constexpr double explained = 1e-4;
      double difference = 0, largest = 0;
      for (std::size_t i = k * n; i < (k + 1) * n; ++i) {
        difference = std::max(difference, std::abs(coarse[i] - fine[i]));
        largest = std::max(largest, std::abs(fine[i]));
      }
      const Channel channel = twisted_.channels[k];
      const char* const unit = channel == Channel::torque                                                 ? "mN.mm"
                               : channel == Channel::axial_force                                          ? "mN"
                               : channel == Channel::outer_diameter || channel == Channel::inner_diameter ? "mm"
                                                                                                          : "1";
      found.push_back({fmt::format("twice as many Gauss points: {}", rows_.channels[k]), difference, unit,
                       explained * largest, std::vector<double>(size)});
      for (std::size_t i = k * n; i < (k + 1) * n; ++i) found.back().shift[i] = fine[i] - coarse[i];
    }
    return {};
  }

 private:
  Status twist_with(int points, const TestInput& input, const TestOutput& output) const {
    if (Status status = detail::elastic_only("torsion", input, output); !status.ok()) return status;
    const bool wants_parameters = !output.jacobian.empty();
    const double thickness = twisted_.outer_radius - twisted_.inner_radius;
    const double inner =
        twisted_.solid() ? 0 : twisted_.outer_radius - thickness * (1 + input.test_parameters[thickness_error]);
    if (!twisted_.solid() && !(inner > 0 && inner < twisted_.outer_radius))
      return Status::failed(fmt::format("torsion: a thickness error of {:g} leaves no tube; narrow its bounds",
                                        input.test_parameters[thickness_error]));
    Section section(input.model, input.model_parameters, twisted_.outer_radius, points);
    const std::size_t n = rows_.count, size = n * twisted_.channels.size(), parameters = input.model_parameters.size();
    double y = twisted_.solid() ? 0 : std::log(inner);
    for (std::size_t i = 0; i < n; ++i) {
      TwistedRows::Row row = twisted_.row(input, i);
      row.axial_stretch += input.test_parameters[axial_stretch_error];
      if (!(row.axial_stretch > 0 && std::isfinite(row.axial_stretch) && std::isfinite(row.twist) &&
            std::isfinite(row.pressure)))
        return Status::failed("torsion: no such specimen at " + twisted_.row_name(input, i));
      std::array<double, variable_count> at{y, row.axial_stretch, row.twist, inner};
      if (!settle(section, row.pressure, at))
        return Status::failed("torsion: no equilibrium is found at " + twisted_.row_name(input, i) +
                              ", since the energy is undefined or overflows, or the pressure is beyond its largest; "
                              "narrow the bounds of the model's parameters");
      y = at[ln_inner];
      if (wants_parameters && !section.evaluate(at, true))
        return Status::failed("torsion: a derivative overflows at " + twisted_.row_name(input, i));
      write(section, at, i, parameters, size, output);
    }
    return {};
  }

  /// Newton's method on P(y) = pressure, the step halved until the pressure comes nearer.
  [[nodiscard]] bool settle(Section& section, double pressure, std::array<double, variable_count>& at) const {
    if (!section.evaluate(at, false)) return false;
    if (twisted_.solid()) return true;
    constexpr int most = 60, most_halvings = 30;
    constexpr double last_step = 1e-9, largest_step = 0.3;  // what the last one leaves is its square
    for (int iteration = 0; iteration < most; ++iteration) {
      const Jet p = section.loads().pressure;
      const double off = p.a - pressure, slope = p.v[ln_inner];
      if (!(slope > 0)) return false;
      double step = std::clamp(-off / slope, -largest_step, largest_step);
      const double from = at[ln_inner];
      for (int halving = 0;; ++halving, step /= 2) {
        at[ln_inner] = from + step;
        if (section.evaluate(at, false) &&
            (std::abs(section.loads().pressure.a - pressure) < std::abs(off) || std::abs(step) < last_step))
          break;
        if (halving == most_halvings) return false;
      }
      if (std::abs(step) < last_step) return section.loads().pressure.v[ln_inner] > 0;
    }
    return false;
  }

  /// A channel as a function of the variables, from the loads of the section.
  [[nodiscard]] Jet channel(Channel which, const Loads& loads, const std::array<double, variable_count>& at) const {
    const Jet y(at[ln_inner], ln_inner), lambda(at[axial], axial), Ri(at[inner], inner);
    const double Ro = twisted_.outer_radius;
    const Jet ri2 = twisted_.solid() ? Jet(0) : exp(2.0 * y);
    const Jet ro = sqrt(ri2 + (Ro * Ro - Ri * Ri) / lambda);
    switch (which) {
      case Channel::torque:
        return loads.torque;
      case Channel::axial_force:
        return loads.force;
      case Channel::outer_diameter:
        return 2.0 * ro;
      case Channel::inner_diameter:
        return 2.0 * exp(y);
      case Channel::outer_diameter_stretch:
        return ro / Ro;
      case Channel::inner_diameter_stretch:
        break;
    }
    return exp(y) / Ri;
  }

  void write(const Section& section, const std::array<double, variable_count>& at, std::size_t i,
             std::size_t parameters, std::size_t size, const TestOutput& output) const {
    const Loads& loads = section.loads();
    const Jet& p = loads.pressure;
    const double slope = twisted_.solid() ? 1 : p.v[ln_inner];
    const std::size_t n = rows_.count, m = twisted_.channels.size();
    std::vector<Jet> channels;
    for (const Channel which : twisted_.channels) channels.push_back(channel(which, loads, at));
    for (std::size_t k = 0; k < m && !output.values.empty(); ++k) output.values[k * n + i] = channels[k].a;
    if (!output.diagnostics.empty()) {
      const double ro = channel(Channel::outer_diameter, loads, at).a / 2;
      output.diagnostics[i] = twisted_.solid() ? 0 : std::exp(at[ln_inner]);
      output.diagnostics[n + i] = ro;
      output.diagnostics[2 * n + i] = std::abs(ro * at[twist]);
    }
    // Of a tube y follows the others: 0 = ∂P/∂y dy + ∂P/∂v dv + dP − dpressure.
    const auto along = [&](std::size_t k, int v, double pressure) {
      const double moved = twisted_.solid() ? 0 : (pressure - (v < 0 ? 0 : p.v[v])) / slope;
      return (v < 0 ? 0 : channels[k].v[v]) + channels[k].v[ln_inner] * moved;
    };
    for (std::size_t k = 0; k < m && !output.abscissa_derivative.empty(); ++k) {
      const auto set = [&](std::size_t column, double value) {
        output.abscissa_derivative[column * size + k * n + i] = value;
      };
      set(twisted_.twist_column, twisted_.radians_per_unit() * along(k, twist, 0));
      if (twisted_.stretch_column) set(*twisted_.stretch_column, along(k, axial, 0));
      if (twisted_.pressure_column) set(*twisted_.pressure_column, twisted_.solid() ? 0 : along(k, -1, 1));
    }
    if (output.jacobian.empty()) return;
    for (std::size_t j = 0; j < parameters; ++j) {
      const Loads change = section.by_parameter(j);
      const double moved = twisted_.solid() ? 0 : -change.pressure.a / slope;
      for (std::size_t k = 0; k < m; ++k) {
        const double own = twisted_.channels[k] == Channel::torque        ? change.torque.a
                           : twisted_.channels[k] == Channel::axial_force ? change.force.a
                                                                          : 0;
        output.jacobian[j * size + k * n + i] = own + channels[k].v[ln_inner] * moved;
      }
    }
    const double thickness = twisted_.outer_radius - twisted_.inner_radius;
    for (std::size_t k = 0; k < m; ++k) {
      output.jacobian[(parameters + axial_stretch_error) * size + k * n + i] = along(k, axial, 0);
      if (!twisted_.solid())
        output.jacobian[(parameters + thickness_error) * size + k * n + i] = -thickness * along(k, inner, 0);
    }
  }

  TwistedRows twisted_;
  int points_;
  TestRows rows_;
  TestDescription description_;
};

TestFactory factory() {
  const auto size = [](const char* name, const char* doc) { return Option::quantity(name, "mm", 0, doc, 0.0); };
  return {
      "torsion",
      "A long tube or solid cylinder that is twisted, at prescribed axial stretch and pressure.",
      "Rivlin, Phil. Trans. R. Soc. A 242:173 (1949)",
      {size("inner_radius", "Inner radius of the unloaded tube; a solid cylinder has none."),
       size("outer_radius", "Outer radius, unloaded."), size("thickness", "Wall thickness of the unloaded tube."),
       size("length", "Unloaded length that twist_angle is over."),
       Option::number("axial_stretch", 0.0, {0.0, 10.0},
                      "Axial stretch that is held; left out where a column is mapped to axial_stretch, else 1."),
       Option::quantity("pressure", "kPa", -1e6, "Inner pressure that is held, where no column is mapped to pressure.",
                        0.0),
       Option::integer("gauss_points", 16, {4, 75}, "Gauss points through the wall, evenly by area.")},
      {{"twist", "deg/mm", Role::abscissa, false, "Angle of twist over the unloaded length.", Kind::plain},
       {"twist_angle", "deg", Role::abscissa, false, "Angle of twist between two sections, \"length\" apart.",
        Kind::plain},
       {"pressure", "kPa", Role::abscissa, false, "Inner pressure.", Kind::plain},
       {"axial_stretch", "1", Role::abscissa, false, "Axial stretch, where it varies along the rows.", Kind::stretch},
       {"torque", "mN.mm", Role::channel, false, "Torque that twists the specimen.", Kind::plain},
       {"axial_force", "mN", Role::channel, false,
        "Reduced axial force: what holds a tube beside the pressure on its closed ends.", Kind::plain},
       {"outer_diameter", "mm", Role::channel, false, "Outer diameter.", Kind::plain},
       {"inner_diameter", "mm", Role::channel, false, "Inner diameter of a tube.", Kind::plain},
       {"outer_diameter_stretch", "1", Role::channel, false, "Outer diameter over that unloaded.", Kind::stretch},
       {"inner_diameter_stretch", "1", Role::channel, false, "Inner diameter of a tube over that unloaded.",
        Kind::stretch}},
      [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<Torsion>(setup); },
      own_parameters(false)};
}

}  // namespace
}  // namespace tunica::torsion

TUNICA_PLUGIN("torsion", TUNICA_PLUGIN_VERSION) { registry.add(tunica::torsion::factory()); }
