// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tunica/test.hpp"

namespace tunica::torsion {

enum class Channel {
  torque,
  axial_force,
  outer_diameter,
  inner_diameter,
  outer_diameter_stretch,
  inner_diameter_stretch
};

/// A tube or solid cylinder under twist as it was bound: unloaded radii in mm, what is prescribed, what is measured.
struct TwistedRows {
  double inner_radius = 0, outer_radius = 0;  ///< inner 0: solid
  double length = 0;                          ///< of the twist angle, mm
  double pressure = 0, axial_stretch = 1;     ///< where they are held
  std::vector<Channel> channels;
  std::vector<std::vector<double>> columns;  ///< the mapped abscissae, in the order of the mapping
  std::vector<std::string> names;            ///< of the columns
  /// Columns of the prescribed quantities.
  std::size_t twist_column = 0;
  std::optional<std::size_t> pressure_column, stretch_column;
  bool by_angle = false;  ///< the twist is an angle over `length`

  TwistedRows() = default;
  /// From the options and the rows; throws InputError where they make no specimen.
  explicit TwistedRows(const TestSetup& setup);

  [[nodiscard]] bool solid() const { return inner_radius == 0; }
  [[nodiscard]] std::size_t count() const { return columns.front().size(); }
  /// Twist over the unloaded length in 1/mm, by the column's unit.
  [[nodiscard]] double radians_per_unit() const;
  struct Row {
    double twist, pressure, axial_stretch;  ///< 1/mm, kPa, 1
  };
  [[nodiscard]] Row row(const TestInput& input, std::size_t i) const;
  /// "row 3 (twist 2, pressure 16 kPa, axial stretch 1.2)"
  [[nodiscard]] std::string row_name(const TestInput& input, std::size_t i) const;

 private:
  [[nodiscard]] double value(const TestInput& input, std::size_t column, std::size_t i) const {
    return input.abscissae.empty() ? columns[column][i] : input.abscissae[column][i];
  }
  void set_radii(const Options& options);
  void check_rows() const;
};

}  // namespace tunica::torsion
