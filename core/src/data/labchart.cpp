// SPDX-License-Identifier: Apache-2.0
#include "data/labchart.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "data/table_place.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

constexpr std::string_view title_key = "ChannelTitle=", unit_key = "UnitName=", range_key = "Range=",
                           interval_key = "Interval=";

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find('\t', at), line.size());
    cells.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  return cells;
}

/// "mmHg" of "200 mmHg".
std::string_view unit_of_range(std::string_view cell) {
  const std::size_t blank = cell.find_last_of(' ');
  return blank == std::string_view::npos ? std::string_view() : cell.substr(blank + 1);
}

}  // namespace

bool labchart_as_table(const std::filesystem::path& file, std::string_view text, std::string& table) {
  constexpr std::size_t most = 20;  // lines before the rows
  std::vector<std::string_view> names, units, ranges;
  std::vector<std::string_view> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    at = end + 1;
    if (lines.size() == most && names.empty()) return false;
    if (line.starts_with(title_key) && names.empty()) names = cells_of(line);
  }
  if (names.size() < 2) return false;
  std::size_t first = 0;  // row
  while (first < lines.size() && !looks_like_number(cells_of(lines[first]).front(), false)) {
    if (lines[first].starts_with(unit_key)) units = cells_of(lines[first]);
    if (lines[first].starts_with(range_key)) ranges = cells_of(lines[first]);
    ++first;
  }
  if (first == 0 || first == lines.size()) return false;
  for (std::size_t line = first; line < lines.size(); ++line)
    if (lines[line].starts_with(interval_key))
      throw InputError(fmt::format(
          "{}, line {}: a second block of the recording begins here, and each block counts its time from its "
          "own start. Take the lines from here on out, or export one block.",
          file.string(), line + 1));
  table.clear();
  for (std::size_t line = 0; line + 1 < first; ++line) table += '\n';
  table += "Time [s]";
  for (std::size_t k = 1; k < names.size(); ++k) {
    const std::string_view of = k < units.size()    ? units[k]
                                : k < ranges.size() ? unit_of_range(ranges[k])
                                                    : std::string_view();
    table += fmt::format("\t{}{}", names[k], of.empty() ? "" : fmt::format(" [{}]", of));
  }
  table += '\n';
  for (std::size_t line = first; line < lines.size(); ++line) {
    table += lines[line].substr(0, lines[line].find("\t#"));
    table += '\n';
  }
  return true;
}

}  // namespace tunica::data
