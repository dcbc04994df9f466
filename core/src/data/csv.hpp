// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/read_bytes.hpp"
#include "data/rig_request.hpp"

namespace tunica::data {

/// A data file cut into cells, nothing read as a number yet: header `name [unit]`, `#` comment lines, delimiter sniffed
/// from the header (tab, semicolon, comma, else white space), quoted fields as in RFC 4180, BOM and CRLF accepted.
/// Lines above the header and a row of units below it are found, unless the layout says where the table begins.
///
/// The one CSV library Debian packages (libcsv) knows neither comments nor sniffing nor where a cell stands, and the
/// place of a cell is what messages are made of; hence this reader.
struct Csv {
  struct Column {
    std::string text;                 ///< the header cell as written
    std::string name;                 ///< without the unit
    std::optional<std::string> unit;  ///< what stands in the square brackets
  };
  struct Row {
    std::size_t line;                ///< in the file, from 1
    std::vector<std::string> cells;  ///< at least one per column; missing ones are empty
  };
  std::filesystem::path file;
  std::size_t header_line = 0;
  char delimiter = ',';
  std::optional<char> stated_decimal;  ///< as the layout says
  std::vector<Column> columns;
  std::vector<Row> rows;

  /// The index of the column of that name, that whole header cell, or "#3", the third. Throws InputError with the
  /// nearest name when there is none, or two.
  [[nodiscard]] std::size_t column(std::string_view name) const;
  /// "circ.csv, line 7, column 2 ('stress')", for messages.
  [[nodiscard]] std::string place(std::size_t line, std::size_t column) const;
  /// ',' where the numbers of these columns have decimal commas, else '.'. Never ',' in a comma-delimited file.
  [[nodiscard]] char decimal_mark(const std::vector<std::size_t>& of_columns) const;
  /// The number in a cell. Throws InputError on text, an empty cell, NaN, infinity.
  [[nodiscard]] double number(const Row& row, std::size_t column, char decimal) const;
  /// Call it before names of the header or cells are written to JSON; throws InputError.
  void require_utf8(bool cells) const;
};

/// Throws InputError on an empty file, a file without rows, a file without header (unless the layout names columns by
/// position), an open quote, surplus fields.
Csv parse_csv(const std::filesystem::path& file, std::string_view text, const TableLayout& layout = {});

}  // namespace tunica::data
