// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tunica::data {

/// Where in a file the table of numbers stands.
struct TablePlace {
  std::optional<std::size_t> header;  ///< line of the names of columns, from 1; none: the rows have no names above them
  std::size_t first_row = 0;          ///< line of the first row of numbers
  char delimiter = ',';               ///< ' ' = white space
};

/// At least three lines that have as many fields, two or more, and numbers in the same ones: the run with most numbers.
/// The header is the nearest line above with text where the run has numbers. `delimiter` where the caller knows it.
/// Blank lines and lines that begin with # do not count. None where there is no such run.
std::optional<TablePlace> find_table(std::string_view text, std::optional<char> delimiter);

/// Without the blanks around it.
std::string_view trimmed(std::string_view text);

/// Whether a cell is a number, with a decimal point, or a comma where `comma` allows it.
bool looks_like_number(std::string_view cell, bool comma);

/// The unit that a cell of a row of units states: "mm", "(mm)" or "[mm]"; none where it is not one.
std::optional<std::string> stated_unit(std::string_view cell);

}  // namespace tunica::data
