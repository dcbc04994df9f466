// SPDX-License-Identifier: Apache-2.0
#include "report/table.hpp"

#include <charconv>
#include <cmath>

#include "text/csv.hpp"
#include "text/units.hpp"
#include "tunica/error.hpp"

namespace tunica::report {

namespace {

const std::string nothing;

}  // namespace

std::optional<Table> Table::read(const std::filesystem::path& file, std::string& problem) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return std::nullopt;
  try {
    Table table;
    table.name_ = file.filename().string();
    const std::string text = data::read_bytes(file);
    // A table with only a header is not a fault.
    std::size_t lines = 0;
    for (std::size_t at = 0; at < text.size() && lines < 2; at = text.find('\n', at), at += at != std::string::npos)
      if (text[at] != '#' && text[at] != '\n') ++lines;
    if (lines < 2) return std::nullopt;
    table.csv_ = data::parse_csv(file, text);
    for (auto& row : table.csv_.rows)
      for (std::string& cell : row.cells) cell = text::cell_text(cell);
    return table;
  } catch (const std::exception& reason) {
    problem = reason.what();
    return std::nullopt;
  }
}

std::optional<std::size_t> Table::find(std::string_view column) const {
  for (std::size_t k = 0; k < csv_.columns.size(); ++k)
    if (csv_.columns[k].name == column || csv_.columns[k].text == column) return k;
  return std::nullopt;
}

const std::string& Table::text(std::size_t row, std::size_t column) const {
  const auto& cells = csv_.rows[row].cells;
  return column < cells.size() ? cells[column] : nothing;
}

double Table::number(std::size_t row, std::size_t column) const {
  const std::string& cell = text(row, column);
  double value = NAN;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size() ? value : NAN;
}

const std::string& Table::text(std::size_t row, std::string_view column) const {
  const auto k = find(column);
  return k ? text(row, *k) : nothing;
}

double Table::number(std::size_t row, std::string_view column) const {
  const auto k = find(column);
  return k ? number(row, *k) : NAN;
}

std::string Table::title(std::size_t column) const {
  const auto& header = csv_.columns[column];
  return header.unit && text::is_dimensionless(*header.unit) ? header.name : header.text;
}

std::vector<std::pair<std::string, std::vector<std::size_t>>> Table::groups(std::string_view column) const {
  std::vector<std::pair<std::string, std::vector<std::size_t>>> result;
  const auto k = find(column);
  if (!k) return result;
  std::map<std::string, std::size_t> place;
  for (std::size_t row = 0; row < rows(); ++row) {
    const auto [at, fresh] = place.try_emplace(text(row, *k), result.size());
    if (fresh) result.emplace_back(at->first, std::vector<std::size_t>{});
    result[at->second].second.push_back(row);
  }
  return result;
}

}  // namespace tunica::report
