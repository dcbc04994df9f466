// SPDX-License-Identifier: Apache-2.0
#include "twisted_rows.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "tunica/error.hpp"

namespace tunica::torsion {
namespace {

Channel channel(const std::string& name) {
  if (name == "torque") return Channel::torque;
  if (name == "axial_force") return Channel::axial_force;
  if (name == "outer_diameter") return Channel::outer_diameter;
  if (name == "inner_diameter") return Channel::inner_diameter;
  if (name == "outer_diameter_stretch") return Channel::outer_diameter_stretch;
  return Channel::inner_diameter_stretch;
}

}  // namespace

void TwistedRows::set_radii(const Options& options) {
  const double inner = options.number("inner_radius"), outer = options.number("outer_radius"),
               thickness = options.number("thickness");
  const int given = (inner > 0) + (outer > 0) + (thickness > 0);
  if (given != 2 && !(given == 1 && outer > 0))
    throw InputError(
        "torsion: give \"outer_radius\" alone for a solid cylinder, or two of \"inner_radius\", \"outer_radius\" and "
        "\"thickness\" for a tube, for example \"inner_radius\": \"3.71 mm\", \"thickness\": \"2.06 mm\"");
  inner_radius = inner > 0 || thickness == 0 ? inner : outer - thickness;
  outer_radius = outer > 0 ? outer : inner + thickness;
  if (!(inner_radius >= 0 && outer_radius > inner_radius))
    throw InputError(
        fmt::format("torsion: an inner radius of {:g} mm and an outer one of {:g} mm leave no wall; radii are positive "
                    "and the outer one is larger",
                    inner_radius, outer_radius));
}

TwistedRows::TwistedRows(const TestSetup& setup) {
  set_radii(setup.options);
  length = setup.options.number("length");
  bool twisted = false;
  for (const TestRows::Column& column : setup.rows.abscissae) {
    const std::size_t place = columns.size();
    if (column.observable == "twist" || column.observable == "twist_angle") {
      if (twisted)
        throw InputError(
            "torsion: both 'twist' and 'twist_angle' are mapped, and one of them says how far the specimen is twisted; "
            "keep one");
      twisted = true;
      by_angle = column.observable == "twist_angle";
      twist_column = place;
    }
    if (column.observable == "pressure") pressure_column = place;
    if (column.observable == "axial_stretch") stretch_column = place;
    names.push_back(column.observable);
    columns.emplace_back(column.values.begin(), column.values.end());
  }
  if (!twisted)
    throw InputError(
        "torsion: no column is mapped to 'twist', the angle over the unloaded length, or to 'twist_angle'; map one in "
        "\"columns\"");
  if (by_angle && length == 0)
    throw InputError(
        "torsion: 'twist_angle' is mapped, and \"length\" is missing; give the unloaded length that the angle is over, "
        "for example \"12 mm\"");
  axial_stretch = setup.options.number("axial_stretch");
  if (stretch_column && axial_stretch != 0)
    throw InputError("torsion: the axial stretch is given twice, as an option and as a column; keep one");
  if (axial_stretch == 0) axial_stretch = 1;
  pressure = setup.options.number("pressure");
  if (pressure_column && pressure != 0)
    throw InputError("torsion: the pressure is given twice, as an option and as a column; keep one");
  for (const std::string& name : setup.rows.channels) {
    channels.push_back(channel(name));
    if (solid() && name.starts_with("inner_diameter"))
      throw InputError(fmt::format(
          "torsion: a column is mapped to '{}', and the cylinder is solid; give \"inner_radius\", or take it out",
          name));
  }
  check_rows();
}

void TwistedRows::check_rows() const {
  if (columns.front().empty()) throw InputError("torsion: there are no rows");
  for (std::size_t i = 0; i < count(); ++i) {
    if (!std::isfinite(columns[twist_column][i]))
      throw InputError(fmt::format("torsion: the twist of row {} is no number", i + 1));
    if (stretch_column && !(columns[*stretch_column][i] > 0 && std::isfinite(columns[*stretch_column][i])))
      throw InputError(fmt::format("torsion: row {} has axial stretch {:g}; a stretch is positive", i + 1,
                                   columns[*stretch_column][i]));
    const double p = pressure_column ? columns[*pressure_column][i] : pressure;
    if (!std::isfinite(p)) throw InputError(fmt::format("torsion: the pressure of row {} is no number", i + 1));
    if (solid() && p != 0)
      throw InputError(
          fmt::format("torsion: row {} has a pressure of {:g} kPa, and the cylinder is solid; give \"inner_radius\" of "
                      "a tube, or take the pressure out",
                      i + 1, p));
  }
}

double TwistedRows::radians_per_unit() const { return std::numbers::pi / 180 / (by_angle ? length : 1); }

TwistedRows::Row TwistedRows::row(const TestInput& input, std::size_t i) const {
  return {radians_per_unit() * value(input, twist_column, i),
          pressure_column ? value(input, *pressure_column, i) : pressure,
          stretch_column ? value(input, *stretch_column, i) : axial_stretch};
}

std::string TwistedRows::row_name(const TestInput& input, std::size_t i) const {
  const Row at = row(input, i);
  return fmt::format("row {} ({} {:g}, pressure {:g} kPa, axial stretch {:g})", i + 1, names[twist_column],
                     at.twist / radians_per_unit(), at.pressure, at.axial_stretch);
}

}  // namespace tunica::torsion
