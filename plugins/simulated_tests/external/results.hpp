// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace tunica::external {

/// Where the numbers of one observable stand in the files of a run.
struct ResultPlace {
  enum class Kind {
    column,   ///< of a table: commas, semicolons, tabs or blanks between cells, names in its first line or none
    pointer,  ///< into a JSON document: a number or a list of numbers
    pattern   ///< in any text: the first group of every match of a regular expression, in their order
  };
  std::string observable;
  std::string file;  ///< name in the scratch folder
  Kind kind = Kind::column;
  std::string text;           ///< name of the column or its number from 1, JSON pointer, or pattern
  double factor = 1;          ///< from the solver's number to the base unit
  std::vector<double> start;  ///< put before what is found, in the solver's unit: the state that it does not print
};

/// The most that is read of one file, in bytes.
inline constexpr std::size_t largest_file = std::size_t{256} << 20U;

/// The whole text of a regular file of at most `largest` bytes; throws std::runtime_error that says what it is instead,
/// for example "was not written".
std::string text_below(const std::filesystem::path& file, std::size_t largest);

/// The numbers, in base units; or what is missing, with file, place and what was found instead.
std::variant<std::vector<double>, std::string> read_result(const ResultPlace& place,
                                                           const std::filesystem::path& folder);

}  // namespace tunica::external
