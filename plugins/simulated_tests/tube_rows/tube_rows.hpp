// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tunica/test.hpp"

namespace tunica {

/// What every test of a pressurised tube is bound to: unloaded radii in mm, what is prescribed and what is measured at
/// each row. `test` is the type's name, for messages.
struct TubeRows {
  enum class Channel { outer_diameter, inner_diameter, outer_diameter_stretch, inner_diameter_stretch, axial_force };

  std::string test;
  double inner_radius = 0, outer_radius = 0;
  std::vector<Channel> channels;
  std::vector<std::vector<double>> columns;  ///< the mapped abscissae, in the order of the mapping
  std::vector<std::string> names;            ///< of the columns
  std::size_t pressure_column = 0;
  bool stretch_varies = false;  ///< the axial stretch is a column, number `stretch_column`
  std::size_t stretch_column = 0;
  double axial_stretch = 1;  ///< held, where it is no column
  std::vector<double> time;  ///< empty = equilibrium

  TubeRows() = default;
  /// From the options of tube_options() and the rows; throws InputError where they make no tube.
  TubeRows(const TestSetup& setup, std::string test);

  [[nodiscard]] std::size_t count() const { return columns.front().size(); }
  /// Pressure and axial stretch of every row, abscissae corrected by mechanisms and by `axial_stretch_error`.
  Status prescribed(const TestInput& input, double axial_stretch_error, std::vector<double>& pressure,
                    std::vector<double>& stretch) const;
  /// "row 3 (pressure 16 kPa, axial stretch 1.2)"
  [[nodiscard]] static std::string row_name(std::size_t row, double pressure, double axial_stretch);
};

/// The options that TubeRows reads: inner_radius, outer_radius, thickness, axial_stretch.
std::vector<Option> tube_options();
/// Abscissae pressure and axial_stretch, time, and the channels.
std::vector<Observable> tube_observables();
/// Native imperfections that every tube has, with the null 0.
Parameter axial_stretch_error_parameter();
Parameter thickness_error_parameter();

}  // namespace tunica
