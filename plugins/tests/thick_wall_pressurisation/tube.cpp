// SPDX-License-Identifier: Apache-2.0
#include "tube.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tunica::thick_wall {
namespace {

Channel channel(const std::string& name) {
  if (name == "outer_diameter") return Channel::outer_diameter;
  if (name == "inner_diameter") return Channel::inner_diameter;
  if (name == "outer_diameter_stretch") return Channel::outer_diameter_stretch;
  if (name == "inner_diameter_stretch") return Channel::inner_diameter_stretch;
  return Channel::axial_force;
}

/// Two of inner radius, outer radius and thickness make the third; 0 stands for "not given".
void set_radii(const Options& options, Tube& tube) {
  const double inner = options.number("inner_radius"), outer = options.number("outer_radius"),
               thickness = options.number("thickness");
  if ((inner > 0) + (outer > 0) + (thickness > 0) != 2)
    throw InputError(
        "thick_wall_pressurisation: give two of \"inner_radius\", \"outer_radius\" and \"thickness\" of the unloaded "
        "tube, for example \"inner_radius\": \"3.71 mm\", \"thickness\": \"2.06 mm\"; the third follows");
  tube.inner_radius = inner > 0 ? inner : outer - thickness;
  tube.outer_radius = outer > 0 ? outer : inner + thickness;
  if (!(tube.inner_radius > 0 && tube.outer_radius > tube.inner_radius))
    throw InputError(
        fmt::format("thick_wall_pressurisation: an inner radius of {:g} mm and an outer one of {:g} mm "
                    "leave no wall; radii are positive and the outer one is larger",
                    tube.inner_radius, tube.outer_radius));
}

void check_rows(const Tube& tube) {
  if (tube.columns.front().empty()) throw InputError("thick_wall_pressurisation: there are no rows");
  for (std::size_t i = 0; i < tube.count(); ++i) {
    if (!std::isfinite(tube.columns[tube.pressure_column][i]))
      throw InputError(fmt::format("thick_wall_pressurisation: the pressure of row {} is no number", i + 1));
    if (!tube.stretch_varies) continue;
    const double stretch = tube.columns[tube.stretch_column][i];
    if (!(stretch > 0 && std::isfinite(stretch)))
      throw InputError(fmt::format("thick_wall_pressurisation: row {} has axial stretch {:g}; a stretch is positive",
                                   i + 1, stretch));
  }
  for (std::size_t i = 1; i < tube.time.size(); ++i)
    if (!(tube.time[i] >= tube.time[i - 1]))
      throw InputError(fmt::format(
          "thick_wall_pressurisation: time runs backwards at row {}; rows must stand in loading order", i + 1));
}

}  // namespace

std::vector<Parameter> own_parameters() {
  return {{"opening_angle", "deg", 0, -90, 330, Scale::linear,
           "Residual stress: the whole missing arc of the stress-free sector (twice Fung's angle).",
           "Chuong, Fung, J. Biomech. Eng. 108:189 (1986)"},
          {"axial_stretch_error", "1", 0, -0.2, 0.2, Scale::linear, "True axial stretch minus the recorded one.", ""},
          {"tethering", "kPa", 0, 0, 100, Scale::linear,
           "Support from outside: pressure per outer diameter stretch gained since zero pressure.", ""},
          {"thickness_error", "1", 0, -0.5, 0.5, Scale::linear,
           "True wall thickness = recorded one times 1 + this, the outer radius being right.", ""},
          {"layer_ratio", "1", 1, 0.1, 10, Scale::log,
           "Stiffness of the inner layer over that of the outer one, their mean over the thickness being kept.", ""}};
}

std::vector<double> own_nulls() { return {0, 0, 0, 0, 1}; }

Tube bind(const TestSetup& setup) {
  Tube tube;
  set_radii(setup.options, tube);
  tube.layer_interface = setup.options.number("layer_interface");
  tube.same_thickness = setup.options.text("sector") == "same_thickness";
  tube.gauss_points = static_cast<std::size_t>(setup.options.integer("gauss_points"));
  if (tube.gauss_points == 1)
    throw InputError(
        "thick_wall_pressurisation: \"gauss_points\" is 1, which integrates nothing well; give 2 or more, "
        "or 0 to have the number chosen");
  bool pressure = false;
  for (const TestRows::Column& column : setup.rows.abscissae) {
    if (column.observable == "pressure") pressure = true, tube.pressure_column = tube.columns.size();
    if (column.observable == "axial_stretch") tube.stretch_varies = true, tube.stretch_column = tube.columns.size();
    tube.names.push_back(column.observable);
    tube.columns.emplace_back(column.values.begin(), column.values.end());
  }
  if (!pressure) throw InputError("thick_wall_pressurisation: no column is mapped to 'pressure'");
  tube.axial_stretch = setup.options.number("axial_stretch");
  if (tube.stretch_varies == (tube.axial_stretch > 0))
    throw InputError(
        tube.stretch_varies
            ? "thick_wall_pressurisation: the axial stretch is given twice, as an option and as a column; keep one"
            : "thick_wall_pressurisation: the axial stretch is missing; give \"axial_stretch\": 1.2 where it is held, "
              "or map a column to 'axial_stretch'");
  tube.time.assign(setup.rows.time.begin(), setup.rows.time.end());
  for (const std::string& name : setup.rows.channels) tube.channels.push_back(channel(name));
  check_rows(tube);
  return tube;
}

std::string row_name(std::size_t row, double pressure, double axial_stretch) {
  return fmt::format("row {} (pressure {:.6g} kPa, axial stretch {:.6g})", row + 1, pressure, axial_stretch);
}

}  // namespace tunica::thick_wall
