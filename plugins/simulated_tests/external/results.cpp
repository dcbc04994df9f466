// SPDX-License-Identifier: Apache-2.0
#include "results.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <re2/re2.h>

#include "tunica/detail/bounded_json.hpp"

namespace tunica::external {
namespace {

using Json = nlohmann::json;
using Found = std::variant<std::vector<double>, std::string>;

constexpr double most_columns = 1e6;

/// A number as C and Fortran print it: "1.5e-3", "+2", "1.5D-03".
std::optional<double> number_in(std::string text) {
  const std::size_t first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  if (first == std::string::npos) return std::nullopt;
  text = text.substr(first, last - first + 1);
  std::ranges::replace(text, 'D', 'e');
  std::ranges::replace(text, 'd', 'e');
  const char* begin = text.data() + (text.front() == '+' ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

char delimiter_of(const std::string& line) {
  for (const char candidate : {';', ',', '\t'})
    if (line.find(candidate) != std::string::npos) return candidate;
  return ' ';
}

std::vector<std::string> cells_of(const std::string& line, char delimiter) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  std::string cell;
  if (delimiter == ' ')
    while (stream >> cell) cells.push_back(cell);
  else
    while (std::getline(stream, cell, delimiter)) {
      const std::size_t first = cell.find_first_not_of(" \t\r\""), last = cell.find_last_not_of(" \t\r\"");
      cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
    }
  return cells;
}

Found column_of(std::string text, const ResultPlace& place) {
  std::istringstream stream(std::move(text));
  std::vector<double> values;
  std::optional<std::size_t> column;
  if (const auto numbered = number_in(place.text);
      numbered && *numbered >= 1 && *numbered <= most_columns && *numbered == std::floor(*numbered))
    column = static_cast<std::size_t>(*numbered) - 1;
  const bool by_number = column.has_value();
  char delimiter = 0;
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const bool heading = delimiter == 0;
    if (heading) delimiter = delimiter_of(line);
    const std::vector<std::string> cells = cells_of(line, delimiter);
    if (heading && !by_number) {
      const auto found = std::ranges::find(cells, place.text);
      if (found == cells.end())
        return fmt::format("has no column '{}': its first line names {}", place.text, fmt::join(cells, ", "));
      column = static_cast<std::size_t>(found - cells.begin());
      continue;
    }
    const auto value = *column < cells.size() ? number_in(cells[*column]) : std::nullopt;
    if (!value && heading) continue;  // names above numbered columns
    if (!value)
      return fmt::format("has '{}' in column {} of line {} where a number is expected",
                         *column < cells.size() ? cells[*column] : "nothing", place.text, number);
    values.push_back(*value);
  }
  return values;
}

Found pointed_at(const std::string& text, const ResultPlace& place) {
  const Json document = detail::parse_json(text, false, true);
  if (document.is_discarded())
    return detail::excess_of_levels(text, true) == std::string::npos
               ? std::string("is no JSON")
               : fmt::format("has more than {} levels of nesting", detail::deepest_json);
  try {
    const Json& value = document.at(Json::json_pointer(place.text));
    if (value.is_number()) return std::vector<double>{value.get<double>()};
    return value.get<std::vector<double>>();
  } catch (const Json::exception&) {
    return fmt::format("has no number, and no list of numbers, at {}", place.text);
  }
}

Found matches_of(const std::string& text, const ResultPlace& place) {
  // RE2 takes time in proportion to the text, and no stack; (?m): "^" and "$" are the ends of a line.
  const RE2 pattern("(?m)" + place.text, RE2::Quiet);
  std::vector<double> values;
  re2::StringPiece left(text);
  for (std::string number; RE2::FindAndConsume(&left, pattern, &number);) {
    const auto value = number_in(number);
    if (!value) return fmt::format("has '{}' where the pattern expects a number", number);
    values.push_back(*value);
  }
  if (values.empty()) return std::string("has nothing that matches the pattern");
  return values;
}

}  // namespace

std::string text_below(const std::filesystem::path& file, std::size_t largest) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) throw std::runtime_error("was not written");
  std::ifstream stream(file, std::ios::binary);
  if (!stream.is_open()) throw std::runtime_error("cannot be read");
  // The size is not asked for: a program may still be writing.
  std::string text;
  for (std::array<char, 65536> piece; stream.read(piece.data(), piece.size()), stream.gcount() > 0;) {
    text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > largest)
      throw std::runtime_error(fmt::format(
          "has more than {} MiB; let the program write the results alone, or fewer of them", largest >> 20U));
  }
  if (stream.bad()) throw std::runtime_error("cannot be read");
  return text;
}

Found read_result(const ResultPlace& place, const std::filesystem::path& folder) {
  const auto words = [&](const std::string& what) {
    return fmt::format("'{}', where '{}' is to be found, {}", place.file, place.observable, what);
  };
  std::string text;
  try {
    text = text_below(folder / place.file, largest_file);
  } catch (const std::exception& problem) {
    return words(problem.what());
  }
  Found found = place.kind == ResultPlace::Kind::pointer   ? pointed_at(text, place)
                : place.kind == ResultPlace::Kind::pattern ? matches_of(text, place)
                                                           : column_of(std::move(text), place);
  if (const auto* problem = std::get_if<std::string>(&found)) return words(*problem);
  auto& values = std::get<std::vector<double>>(found);
  if (values.empty()) return words("has no rows");
  values.insert(values.begin(), place.start.begin(), place.start.end());
  for (double& value : values) {
    value *= place.factor;
    if (!std::isfinite(value)) return words("has a number that is not finite");
  }
  return found;
}

}  // namespace tunica::external
