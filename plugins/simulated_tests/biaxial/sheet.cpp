// SPDX-License-Identifier: Apache-2.0
#include "sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../loading_order/loading_order.hpp"

namespace tunica::biaxial {
namespace {

constexpr const char* circumferential = "stretch_circumferential";
constexpr const char* axial = "stretch_axial";

/// Which columns are there depends on the protocol, so it is checked here, not by a flag of the observable.
void check_columns(const TestRows& rows, Protocol protocol, const std::string& word) {
  const auto mapped = [&rows](const std::string& name) {
    return std::any_of(rows.abscissae.begin(), rows.abscissae.end(),
                       [&name](const TestRows::Column& column) { return column.observable == name; });
  };
  if (protocol == Protocol::general) {
    for (const char* name : {circumferential, axial})
      if (!mapped(name))
        throw InputError(std::string("biaxial: no column is mapped to '") + name +
                         "', and the protocol 'general' needs both in-plane stretches; map it, or give \"protocol\": "
                         "\"equibiaxial\" or \"pure_shear\", which need the one column 'stretch'");
    if (mapped("stretch"))
      throw InputError(
          "biaxial: a column is mapped to 'stretch', which the protocol 'general' has no use for beside "
          "'stretch_circumferential' and 'stretch_axial'; remove it");
    return;
  }
  if (!mapped("stretch"))
    throw InputError("biaxial: no column is mapped to 'stretch', which the protocol '" + word + "' needs");
  for (const char* name : {circumferential, axial})
    if (mapped(name))
      throw InputError(std::string("biaxial: a column is mapped to '") + name + "', but the protocol '" + word +
                       "' has both stretches from 'stretch'; remove it, or give \"protocol\": \"general\"");
}

InPlane channel(const std::string& name, const Sheet& sheet) {
  if (name == "stress_circumferential") return {1, 0};
  if (name == "stress_axial") return {0, 1};
  if (sheet.protocol == Protocol::equibiaxial) return {0.5, 0.5};
  if (sheet.protocol == Protocol::pure_shear) return sheet.direction(0);
  throw InputError(
      "biaxial: a column is mapped to 'stress', the stress along the pulled direction, but the protocol 'general' "
      "pulls both; map it to 'stress_circumferential' or 'stress_axial'");
}

void check_rows(const Sheet& sheet) {
  if (sheet.columns.front().empty()) throw InputError("biaxial: there are no rows");
  for (std::size_t k = 0; k < sheet.columns.size(); ++k)
    for (std::size_t i = 0; i < sheet.columns[k].size(); ++i)
      if (!(sheet.columns[k][i] > 0 && std::isfinite(sheet.columns[k][i])))
        throw InputError("biaxial: row " + std::to_string(i + 1) + " has '" + sheet.names[k] + "' " +
                         std::to_string(sheet.columns[k][i]) + "; a stretch is positive");
  check_loading_order("biaxial", sheet.time);
}

}  // namespace

InPlane Sheet::direction(std::size_t column) const {
  if (protocol == Protocol::equibiaxial) return {1, 1};
  const std::size_t axis = protocol == Protocol::pure_shear ? pulled : names[column] == axial ? 1 : 0;
  return axis == 0 ? InPlane{1, 0} : InPlane{0, 1};
}

InPlane Sheet::held() const {
  if (protocol != Protocol::pure_shear) return {0, 0};
  return pulled == 0 ? InPlane{0, 1} : InPlane{1, 0};
}

std::string Sheet::row_name(std::span<const std::span<const double>> values, std::size_t row) const {
  std::string text = "row " + std::to_string(row + 1) + " (";
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k > 0 ? ", " : "") + names[k] + " " + std::to_string(values[k][row]);
  return text + ")";
}

Sheet bind(const TestSetup& setup) {
  const std::string& word = setup.options.text("protocol");
  Sheet sheet;
  sheet.protocol = word == "equibiaxial"  ? Protocol::equibiaxial
                   : word == "pure_shear" ? Protocol::pure_shear
                                          : Protocol::general;
  sheet.pulled = setup.options.text("direction") == "axial" ? 1 : 0;
  sheet.angle = setup.options.number("angle") * std::numbers::pi / 180;
  sheet.power = setup.stress_measure == "first_piola_kirchhoff"    ? 1
                : setup.stress_measure == "second_piola_kirchhoff" ? 2
                                                                   : 0;
  check_columns(setup.rows, sheet.protocol, word);
  for (const TestRows::Column& column : setup.rows.abscissae) {
    sheet.names.push_back(column.observable);
    sheet.columns.emplace_back(column.values.begin(), column.values.end());
  }
  sheet.time.assign(setup.rows.time.begin(), setup.rows.time.end());
  for (const std::string& name : setup.rows.channels) sheet.channels.push_back(channel(name, sheet));
  check_rows(sheet);
  return sheet;
}

}  // namespace tunica::biaxial
