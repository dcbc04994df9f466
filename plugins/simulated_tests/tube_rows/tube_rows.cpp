// SPDX-License-Identifier: Apache-2.0
#include "tube_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "../loading_order/loading_order.hpp"
#include "tunica/error.hpp"

namespace tunica {
namespace {

using Channel = TubeRows::Channel;

Channel channel(const std::string& name) {
  if (name == "outer_diameter") return Channel::outer_diameter;
  if (name == "inner_diameter") return Channel::inner_diameter;
  if (name == "outer_diameter_stretch") return Channel::outer_diameter_stretch;
  if (name == "inner_diameter_stretch") return Channel::inner_diameter_stretch;
  return Channel::axial_force;
}

/// Two of inner radius, outer radius and thickness make the third; 0 stands for "not given". Layers make a thickness.
void set_radii(const Options& options, std::span<const double> layers, TubeRows& tube) {
  const double inner = options.number("inner_radius"), outer = options.number("outer_radius"),
               together = std::accumulate(layers.begin(), layers.end(), 0.0);
  double thickness = options.number("thickness");
  if (thickness == 0 && (inner > 0) + (outer > 0) == 1) thickness = together;
  if ((inner > 0) + (outer > 0) + (thickness > 0) != 2)
    throw InputError(tube.test +
                     ": give two of \"inner_radius\", \"outer_radius\" and \"thickness\" of the unloaded tube, for "
                     "example \"inner_radius\": \"3.71 mm\", \"thickness\": \"2.06 mm\"; the third follows");
  tube.inner_radius = inner > 0 ? inner : outer - thickness;
  tube.outer_radius = outer > 0 ? outer : inner + thickness;
  if (!(tube.inner_radius > 0 && tube.outer_radius > tube.inner_radius))
    throw InputError(
        fmt::format("{}: an inner radius of {:g} mm and an outer one of {:g} mm leave no wall; radii are positive and "
                    "the outer one is larger",
                    tube.test, tube.inner_radius, tube.outer_radius));
  const double wall = tube.outer_radius - tube.inner_radius;
  constexpr double rounding = 1e-6;
  if (!layers.empty() && std::abs(together - wall) > rounding * wall)
    throw InputError(
        fmt::format("{}: the layers are {:.6g} mm thick together, and the wall is {:.6g} mm; make them agree, or leave "
                    "\"thickness\" out, which then follows from the layers",
                    tube.test, together, wall));
}

void check_rows(const TubeRows& tube) {
  if (tube.columns.front().empty()) throw InputError(tube.test + ": there are no rows");
  for (std::size_t i = 0; i < tube.count(); ++i) {
    if (!std::isfinite(tube.columns[tube.pressure_column][i]))
      throw InputError(fmt::format("{}: the pressure of row {} is no number", tube.test, i + 1));
    if (!tube.stretch_varies) continue;
    const double stretch = tube.columns[tube.stretch_column][i];
    if (!(stretch > 0 && std::isfinite(stretch)))
      throw InputError(
          fmt::format("{}: row {} has axial stretch {:g}; a stretch is positive", tube.test, i + 1, stretch));
  }
  check_loading_order(tube.test, tube.time);
}

Option radius(const char* name, const char* doc) { return Option::quantity(name, "mm", 0.0, doc, 0.0); }

}  // namespace

TubeRows::TubeRows(const TestSetup& setup, std::string name) : test(std::move(name)) {
  set_radii(setup.options, setup.layers, *this);
  bool pressure = false;
  for (const TestRows::Column& column : setup.rows.abscissae) {
    if (column.observable == "pressure") {
      pressure = true;
      pressure_column = columns.size();
    }
    if (column.observable == "axial_stretch") {
      stretch_varies = true;
      stretch_column = columns.size();
    }
    names.push_back(column.observable);
    columns.emplace_back(column.values.begin(), column.values.end());
  }
  if (!pressure) throw InputError(test + ": no column is mapped to 'pressure'");
  axial_stretch = setup.options.number("axial_stretch");
  if (stretch_varies == (axial_stretch > 0))
    throw InputError(test + (stretch_varies
                                 ? ": the axial stretch is given twice, as an option and as a column; keep one"
                                 : ": the axial stretch is missing; give \"axial_stretch\": 1.2 where it is held, "
                                   "or map a column to 'axial_stretch'"));
  time.assign(setup.rows.time.begin(), setup.rows.time.end());
  for (const std::string& channel_name : setup.rows.channels) channels.push_back(channel(channel_name));
  check_rows(*this);
}

Status TubeRows::prescribed(const TestInput& input, double axial_stretch_error, std::vector<double>& pressure,
                            std::vector<double>& stretch) const {
  const auto column = [&](std::size_t k) {
    return input.abscissae.empty() ? std::span<const double>(columns[k]) : input.abscissae[k];
  };
  const std::span<const double> p = column(pressure_column);
  pressure.assign(p.begin(), p.end());
  stretch.assign(p.size(), axial_stretch);
  if (stretch_varies) std::copy_n(column(stretch_column).begin(), p.size(), stretch.begin());
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (axial_stretch_error != 0) stretch[i] += axial_stretch_error;
    if (!(stretch[i] > 0 && std::isfinite(stretch[i]) && std::isfinite(p[i])))
      return Status::failed(test + ": no such tube at " + row_name(i, p[i], stretch[i]));
  }
  return {};
}

std::string TubeRows::row_name(std::size_t row, double pressure, double axial_stretch) {
  return fmt::format("row {} (pressure {:.6g} kPa, axial stretch {:.6g})", row + 1, pressure, axial_stretch);
}

std::vector<Option> tube_options() {
  return {radius("inner_radius", "Inner radius of the unloaded tube; two of the three lengths are given."),
          radius("outer_radius", "Outer radius of the unloaded tube."),
          radius("thickness", "Wall thickness of the unloaded tube."),
          Option::number("axial_stretch", 0.0, {0.0, 10.0},
                         "Axial stretch that is held; left out where a column is mapped to axial_stretch.")};
}

std::vector<Observable> tube_observables() {
  using Role = Observable::Role;
  using Kind = Observable::Kind;
  return {
      {"pressure", "kPa", Role::abscissa, true, "Inner pressure.", Kind::plain},
      {"axial_stretch", "1", Role::abscissa, false, "Axial stretch, where it varies along the rows.", Kind::stretch},
      {"time", "s", Role::time, false, "Time since the unloaded state.", Kind::plain},
      {"outer_diameter", "mm", Role::channel, false, "Outer diameter.", Kind::plain},
      {"inner_diameter", "mm", Role::channel, false, "Inner diameter.", Kind::plain},
      {"outer_diameter_stretch", "1", Role::channel, false, "Outer diameter over that of the unloaded tube.",
       Kind::stretch},
      {"inner_diameter_stretch", "1", Role::channel, false, "Inner diameter over that of the unloaded tube.",
       Kind::stretch},
      {"axial_force", "mN", Role::channel, false,
       "Reduced axial force: what holds the tube beside the pressure on its closed ends.", Kind::plain}};
}

Parameter axial_stretch_error_parameter() {
  return {"axial_stretch_error", "1", 0, -0.2, 0.2, Scale::linear, "True axial stretch minus the recorded one.", ""};
}

Parameter thickness_error_parameter() {
  return {"thickness_error",
          "1",
          0,
          -0.5,
          0.5,
          Scale::linear,
          "True wall thickness = recorded one times 1 + this, the outer radius being right.",
          ""};
}

}  // namespace tunica
