// SPDX-License-Identifier: Apache-2.0
#include "data/dmc.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "data/nearest.hpp"
#include "data/table_place.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

using Cells = std::vector<std::string_view>;

Cells tabbed(std::string_view line) {
  Cells cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find('\t', at), line.size());
    cells.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  return cells;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

/// With a point or a comma, as the machine that wrote it is set up.
std::optional<double> number(std::string_view cell) {
  std::string digits(cell.substr(cell.starts_with('+') ? 1 : 0));
  std::replace(digits.begin(), digits.end(), ',', '.');
  double value = 0;
  const char* const last = digits.data() + digits.size();
  const auto [end, error] = std::from_chars(digits.data(), last, value);
  return error == std::errc() && end == last ? std::optional(value) : std::nullopt;
}

/// The table above the rows: a line of each, a cell a channel.
struct Calibration {
  Cells channel, unit, scale, offset;
  std::optional<double> frequency;

  void read(std::string_view line) {
    constexpr std::string_view of_samples = "Sample Frequency (Hz):";
    if (line.starts_with(of_samples)) frequency = number(trimmed(line.substr(of_samples.size())));
    for (const auto& [key, cells] : {std::pair{"Channel\t", &channel}, std::pair{"Units\t", &unit},
                                     std::pair{"Scale (", &scale}, std::pair{"Offset (", &offset}})
      if (line.starts_with(key)) *cells = tabbed(line);
  }
  /// Of the column of this name: its place; none where it has no scale.
  [[nodiscard]] std::optional<std::size_t> of(std::string_view name) const {
    const auto found = channel.empty() ? channel.end() : std::find(channel.begin() + 1, channel.end(), name);
    if (found == channel.end()) return std::nullopt;
    const auto k = static_cast<std::size_t>(found - channel.begin());
    const bool known = k < scale.size() && k < offset.size() && number(scale[k]) && number(offset[k]);
    return known ? std::optional(k) : std::nullopt;
  }
};

}  // namespace

bool dmc_as_table(const std::filesystem::path& file, std::string_view text, std::string& table) {
  constexpr std::string_view begins = "Test Data in Volts", calibrates = "Calibration Data";  // headings of the format
  if (text.find(begins) == std::string_view::npos || text.find(calibrates) == std::string_view::npos) return false;
  const auto lines = lines_of(text);
  Calibration calibration;
  std::size_t header = 0;
  while (header < lines.size() && !lines[header].starts_with(begins)) calibration.read(trimmed(lines[header++]));
  do ++header;
  while (header < lines.size() && trimmed(lines[header]).empty());
  if (header >= lines.size()) return false;
  const Cells names = tabbed(lines[header]);
  std::vector<std::optional<std::size_t>> places;
  for (const std::string_view name : names) places.push_back(calibration.of(name));
  const bool timed = names.front() == "Sample" && calibration.frequency && *calibration.frequency > 0;
  if (!timed || std::none_of(places.begin(), places.end(), [](const auto& place) { return place.has_value(); }))
    throw InputError(fmt::format(
        "{}, line {}: the rows are in volts, and the lines above them do not say the sample frequency, and the scale "
        "and the offset of a channel. Write the file once more, with its header.",
        file.string(), header + 1));
  table.assign(header, '\n');
  table += "Time [s]";
  for (std::size_t k = 1; k < names.size(); ++k) {
    const auto place = places[k];
    const std::string_view unit =
        place && *place < calibration.unit.size() ? calibration.unit[*place] : std::string_view();
    table += fmt::format("\t{}{}", names[k], stated_unit(unit) ? fmt::format(" [{}]", unit) : "");
  }
  table += '\n';
  for (std::size_t line = header + 1; line < lines.size(); ++line) {
    const Cells cells = tabbed(lines[line]);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (k > 0) table += '\t';
      const auto value = number(cells[k]);
      const auto place = k < places.size() ? places[k] : std::nullopt;
      if (value && k == 0)
        table += fmt::format("{}", *value / *calibration.frequency);
      else if (value && place)
        table += fmt::format("{}", (*value + *number(calibration.offset[*place])) * *number(calibration.scale[*place]));
      else if ((place || k == 0) && !cells[k].empty())
        throw InputError(
            fmt::format("{}, line {}, column {}: found '{}' where a voltage is expected. Correct the cell.",
                        file.string(), line + 1, k + 1, excerpt(cells[k])));
      else
        table += cells[k];
    }
    table += '\n';
  }
  return true;
}

}  // namespace tunica::data
