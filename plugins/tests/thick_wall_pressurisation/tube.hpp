// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tunica/test.hpp"

namespace tunica::thick_wall {

enum class Channel { outer_diameter, inner_diameter, outer_diameter_stretch, inner_diameter_stretch, axial_force };

/// The test's own parameters, in this order: the native imperfections, each with a null.
enum Own : std::size_t { opening_angle, axial_stretch_error, tethering, thickness_error, layer_ratio, own_count };
std::vector<Parameter> own_parameters();
std::vector<double> own_nulls();

/// The tube as it was bound: unloaded radii in mm, what is prescribed and what is measured at each row.
struct Tube {
  double inner_radius = 0, outer_radius = 0;
  double layer_interface = 0.5;  ///< where the inner layer ends, as a fraction of the thickness
  bool same_thickness = false;   ///< the opened sector is as thick as the wall, instead of in equilibrium when closed
  std::size_t gauss_points = 0;  ///< in each layer; 0 = chosen by the estimated error
  std::vector<Channel> channels;
  std::vector<std::vector<double>> columns;  ///< the mapped abscissae, in the order of the mapping
  std::vector<std::string> names;            ///< of the columns
  std::size_t pressure_column = 0;
  bool stretch_varies = false;  ///< the axial stretch is a column, number `stretch_column`
  std::size_t stretch_column = 0;
  double axial_stretch = 1;  ///< held, where it is no column
  std::vector<double> time;  ///< empty = equilibrium

  [[nodiscard]] std::size_t count() const { return columns.front().size(); }
};

/// Binds options and rows; throws InputError where they make no tube.
Tube bind(const TestSetup& setup);

/// "row 3 (pressure 16 kPa, axial stretch 1.2)"
std::string row_name(std::size_t row, double pressure, double axial_stretch);

}  // namespace tunica::thick_wall
