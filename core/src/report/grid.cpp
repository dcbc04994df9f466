// SPDX-License-Identifier: Apache-2.0
#include "report/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fmt/format.h>

namespace tunica::report {

namespace {

using Tree = boost::property_tree::ptree;

/// Numbers apart from each other by white space; "nan" is one.
std::vector<double> numbers(const std::string& text) {
  std::vector<double> values;
  const char* at = text.c_str();
  for (char* end = nullptr;; at = end) {
    const double value = std::strtod(at, &end);
    if (end == at) return values;
    values.push_back(value);
  }
}

std::vector<Grid::Field> fields(const Tree& parent) {
  std::vector<Grid::Field> found;
  for (const auto& [key, array] : parent)
    if (key == "DataArray")
      found.push_back({array.get<std::string>("<xmlattr>.Name", ""),
                       array.get<std::size_t>("<xmlattr>.NumberOfComponents", 1), numbers(array.data())});
  return found;
}

/// Checks the assumptions of a drawing; empty = all hold.
std::string fault(const Grid& grid) {
  if (grid.x.empty() || grid.cells.empty()) return "has no cells";
  if (grid.cells.size() % 4 != 0) return "has cells that are no quadrilaterals";
  if (std::any_of(grid.cells.begin(), grid.cells.end(), [&](std::size_t point) { return point >= grid.x.size(); }))
    return "has cells of points that it does not have";
  for (const Grid::Field& field : grid.of_cells)
    if (field.values.size() != grid.cells.size() / 4)
      return fmt::format("has another number of '{}' than of cells", field.title);
  for (const Grid::Field& field : grid.of_points)
    if (field.values.size() != grid.x.size() * field.components)
      return fmt::format("has another number of '{}' than of points", field.title);
  return "";
}

}  // namespace

std::optional<Grid> Grid::read(const std::filesystem::path& file, std::string& problem) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  Grid grid;
  try {
    Tree tree;
    boost::property_tree::read_xml(file.string(), tree);
    const Tree& piece = tree.get_child("VTKFile.UnstructuredGrid.Piece");
    const auto points = numbers(piece.get_child("Points.DataArray").data());
    for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
      grid.x.push_back(points[i]);
      grid.y.push_back(points[i + 1]);
    }
    for (const auto& array : fields(piece.get_child("Cells")))
      if (array.title == "connectivity")
        for (const double point : array.values)
          grid.cells.push_back(point >= 0 && point < 1e9 ? static_cast<std::size_t>(point) : points.size());
    grid.of_points = fields(piece.get_child("PointData", {}));
    grid.of_cells = fields(piece.get_child("CellData", {}));
  } catch (const boost::property_tree::ptree_error& reason) {
    problem = fmt::format("{}: cannot be read as a VTK grid: {}", file.filename().string(), reason.what());
    return std::nullopt;
  }
  if (const std::string what = fault(grid); !what.empty()) {
    problem = fmt::format("{}: {}", file.filename().string(), what);
    return std::nullopt;
  }
  return grid;
}

}  // namespace tunica::report
