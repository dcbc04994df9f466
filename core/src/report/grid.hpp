// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tunica::report {

/// A mesh of quadrilaterals in the plane, as `tunica run` and `simulate --fields` write it.
struct Grid {
  std::vector<double> x, y;        ///< of each point
  std::vector<std::size_t> cells;  ///< four points each, in turn
  struct Field {
    std::string title;  ///< "axial_stress [kPa]"
    std::size_t components = 1;
    std::vector<double> values;
  };
  std::vector<Field> of_points, of_cells;

  /// VTK's XML format for unstructured grids, in text. Nothing where there is no such file; `problem` says what is
  /// wrong with one that cannot be read.
  static std::optional<Grid> read(const std::filesystem::path& file, std::string& problem);
};

}  // namespace tunica::report
