// SPDX-License-Identifier: Apache-2.0
#include "importing/sizes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "data/cycles.hpp"
#include "data/nearest.hpp"
#include "data/table_place.hpp"
#include "data/units.hpp"
#include "importing/columns.hpp"
#include "importing/words.hpp"
#include "tunica/error.hpp"

namespace tunica::importing {
namespace {

/// Digits behind the decimal mark of a cell.
int digits_behind(const std::string& cell) {
  const std::size_t mark = cell.find_first_of(".,");
  return mark == std::string::npos ? 0 : static_cast<int>(cell.size() - mark - 1);
}

bool begins_like(std::string name, std::string_view word) {
  for (char& letter : name)
    letter = letter == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return name.find(word) != std::string::npos;
}

}  // namespace

std::string direction_named(std::string_view name) {
  const auto words = words_of(name);
  if (has_any(words, {"axial", "longitudinal", "=long", "langs"})) return "axial";
  if (has_any(words, {"circ", "transverse", "=trans", "hoop", "umfang", "=quer"})) return "circumferential";
  return {};
}

KnownSizes sizes_in_table(const std::filesystem::path& table, const std::string& specimen) {
  const data::Csv csv = data::parse_csv(table, data::read_bytes(table));
  const auto named = [&](const data::Csv::Row& one) {
    return std::find(one.cells.begin(), one.cells.end(), specimen) != one.cells.end();
  };
  const auto row = std::find_if(csv.rows.begin(), csv.rows.end(), named);
  if (row == csv.rows.end())
    throw InputError(
        fmt::format("{}: no row has the specimen '{}', the name of its file without ending. Add a row, or "
                    "give --width, --thickness and --gauge-length.",
                    table.string(), data::excerpt(specimen)));
  if (const auto second = std::find_if(row + 1, csv.rows.end(), named); second != csv.rows.end())
    throw InputError(fmt::format("{}: lines {} and {} both have the specimen '{}'. Keep the one whose sizes are right.",
                                 table.string(), row->line, second->line, data::excerpt(specimen)));
  KnownSizes sizes;
  for (std::size_t k = 0; k < csv.columns.size(); ++k) {
    const data::Csv::Column& column = csv.columns[k];
    if (begins_like(column.name, "direction") && !row->cells[k].empty()) {
      sizes.direction = direction_named(row->cells[k]);
      sizes.sources.push_back(
          sizes.direction.empty()
              ? fmt::format("the direction '{}' in {}, line {}, is neither axial nor circumferential, and is not used",
                            data::excerpt(row->cells[k]), table.filename().string(), row->line)
              : fmt::format("direction {} from {}, line {}", sizes.direction, table.filename().string(), row->line));
    }
    const bool area = begins_like(column.name, "area"), diameter = begins_like(column.name, "diameter");
    std::string* const size = area || diameter                           ? &sizes.area
                              : begins_like(column.name, "width")        ? &sizes.width
                              : begins_like(column.name, "thickness")    ? &sizes.thickness
                              : begins_like(column.name, "gauge length") ? &sizes.gauge_length
                              : begins_like(column.name, "initial length") || begins_like(column.name, "height")
                                  ? &sizes.gauge_length
                                  : nullptr;
    if (size == nullptr || row->cells[k].empty()) continue;
    if (has_any(words_of(column.name), {"=sd", "=std", "=sem", "deviation", "error", "uncertainty"})) continue;
    const char* const base = area ? "mm2" : "mm";
    if (column.unit && !measures(*column.unit, base))
      throw InputError(fmt::format("{}, line {}: '{}' has the unit '{}', and one such as {} is expected. Correct it.",
                                   table.string(), csv.header_line, data::excerpt(column.name),
                                   data::excerpt(*column.unit), base));
    const std::string unit = column.unit.value_or(base);
    std::string found = fmt::format("{} {}", csv.number(*row, k, csv.decimal_mark({k})), unit);
    if (diameter) found = circle(found);
    if (!size->empty()) {
      constexpr double alike = 0.01;
      const char* const of = size == &sizes.area ? "mm2" : "mm";
      const double before = data::parse_quantity(*size, of), now = data::parse_quantity(found, of);
      if (std::abs(now - before) <= alike * std::abs(before)) continue;
      throw InputError(
          fmt::format("{}, line {}: '{}' comes to {}, and a column before it to {}. Keep the one that is right.",
                      table.string(), row->line, data::excerpt(column.name), found, *size));
    }
    *size = found;
    sizes.sources.push_back(
        fmt::format("{} {} from {}, line {}{}", column.name, *size, table.filename().string(), row->line,
                    column.unit ? "" : fmt::format("; the table gives no unit, {} is assumed", base)));
  }
  return sizes;
}

std::optional<double> length_at_rest(const data::Csv& csv, const std::string& length, const std::string& displacement,
                                     const std::vector<const data::Csv::Row*>& rows) {
  const std::size_t a = csv.column(length), b = csv.column(displacement);
  const char decimal = csv.decimal_mark({a, b});
  std::vector<double> difference;
  int digits = 0;
  for (const data::Csv::Row* row : rows) {
    difference.push_back(csv.number(*row, a, decimal) - csv.number(*row, b, decimal));
    digits = std::max({digits, digits_behind(row->cells[a]), digits_behind(row->cells[b])});
  }
  if (difference.empty()) return std::nullopt;
  std::vector<double> sorted = difference;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double scale = std::pow(10, digits), rounded = std::round(*middle * scale) / scale;
  const auto agree = std::count_if(difference.begin(), difference.end(),
                                   [&](double one) { return std::abs(one - rounded) <= 1.5 / scale; });
  if (2 * static_cast<std::size_t>(agree) <= difference.size() || !(rounded > 0)) return std::nullopt;
  return rounded;
}

std::vector<double> numbers_of(const data::Csv& csv, const std::string& column,
                               const std::vector<const data::Csv::Row*>& rows) {
  const std::size_t index = csv.column(column);
  const char decimal = csv.decimal_mark({index});
  std::vector<double> path;
  for (const data::Csv::Row* row : rows)
    if (data::looks_like_number(row->cells[index], decimal == ',')) path.push_back(csv.number(*row, index, decimal));
  return path;
}

std::optional<bool> goes_to_and_fro(const data::Csv& csv, const std::string& column,
                                    const std::vector<const data::Csv::Row*>& rows, double rest) {
  const std::vector<double> path = numbers_of(csv, column, rows);
  if (path.empty() || *std::max_element(path.begin(), path.end()) == *std::min_element(path.begin(), path.end()))
    return std::nullopt;
  return data::returns_in(path, data::branches_of(path, rest)) > 0;
}

std::size_t cycles(const data::Csv& csv, const std::string& column, const std::vector<const data::Csv::Row*>& rows,
                   double rest) {
  const std::vector<double> path = numbers_of(csv, column, rows);
  return path.empty() ? 0 : data::cycles_in(data::branches_of(path, rest));
}

std::string circle(const std::string& diameter) {
  const double length = data::parse_quantity(diameter, "mm");
  return fmt::format("{:.6g} mm2", std::acos(-1.0) / 4 * length * length);
}

}  // namespace tunica::importing
