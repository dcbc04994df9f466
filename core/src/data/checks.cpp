// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "data/series.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

using Role = Observable::Role;
using Kind = Observable::Kind;

// No tissue or rubber is stretched twentyfold; for an exception, a unit in the header states it.
constexpr double largest_stretch = 20;

void check_stretch(const Series& series, const Series::Column& column, std::vector<std::string>& warnings) {
  if (std::any_of(column.values.begin(), column.values.end(), [](double value) { return std::isnan(value); })) return;
  const auto [low, high] = std::minmax_element(column.values.begin(), column.values.end());
  const auto row = [&](auto at) { return static_cast<std::size_t>(at - column.values.begin()); };
  const bool from_zero = std::abs(column.values.front()) < 0.1;
  if (from_zero && *low > -1 && *high <= 2)
    throw InputError(
        fmt::format("{}: '{}' begins at {}, so it looks like strain; expected stretch, which is 1 at rest. "
                    "Write stretch = 1 + strain, or map the column as \"strain\".",
                    series.place(0, column), column.name, column.values.front()));
  if ((from_zero && *high > 2) || (*high > largest_stretch && column.unit.empty()))
    throw InputError(fmt::format("{}: found {} where a stretch (1 at rest) is expected; this looks like percent. {}",
                                 series.place(row(high), column), *high,
                                 from_zero || *low < 50 ? "Map the column as \"strain\" with the unit %, in the header "
                                                          "or under \"units\" (a true stretch this large "
                                                          "needs the unit: 'stretch [1]')."
                                                        : "Write the unit in the header: 'stretch [%]'."));
  if (*low < -2)
    throw InputError(fmt::format(
        "{}: found a stretch of {}; this looks like percent. Write the unit in the header, as in 'strain [%]', "
        "or under \"units\".",
        series.place(row(low), column), *low));
  if (*low <= 0)
    throw InputError(
        fmt::format("{}: found a stretch of {}; expected a positive number, 1 at rest, less in compression.",
                    series.place(row(low), column), *low));
  if (*high > largest_stretch)
    warnings.push_back(fmt::format("{}: found a stretch of {}, more than any tissue or rubber bears. Is it percent?",
                                   series.place(row(high), column), *high));
  else if (*low > 2)
    warnings.push_back(
        fmt::format("{}: every stretch is above 2 and none is near 1, the state at rest. Is it percent strain?",
                    series.place(0, column)));
}

/// Rows of a measurement scatter, if only by the last digit of the device; these do not.
void check_straight(const Series& series, const Series::Column& abscissa, const Series::Column& channel,
                    std::vector<std::string>& warnings) {
  constexpr std::size_t fewest = 6;
  constexpr double rounding = 1e-12;  // of the range
  const std::vector<double>&x = abscissa.values, &y = channel.values;
  const auto number = [](double value) { return std::isfinite(value); };
  if (y.size() < fewest || !std::all_of(x.begin(), x.end(), number) || !std::all_of(y.begin(), y.end(), number)) return;
  const double run = x.back() - x.front(), rise = y.back() - y.front();
  if (run == 0 || rise == 0) return;
  for (std::size_t row = 0; row < y.size(); ++row)
    if (!(std::abs(y[row] - y.front() - rise * ((x[row] - x.front()) / run)) <= rounding * std::abs(rise))) return;
  warnings.push_back(fmt::format(
      "{}: the {} rows lie on a straight line over '{}' to the last digit, as no measurement does. Were they "
      "interpolated or computed? There is no scatter to estimate a noise from; state it",
      series.header_place(channel), y.size(), abscissa.name));
}

/// Signs of stress and stretch that do not go together: tension pulls.
void check_sign(const Series& series, const Series::Column& stretch, const Series::Column& stress,
                std::vector<std::string>& warnings) {
  std::size_t tensile = 0, negative = 0, first = 0;
  for (std::size_t row = 0; row < series.lines.size(); ++row) {
    if (stretch.values[row] <= 1 || stress.values[row] == 0) continue;
    ++tensile;
    if (stress.values[row] < 0 && negative++ == 0) first = row;
  }
  if (tensile >= 2 && 2 * negative > tensile)
    warnings.push_back(
        fmt::format("{}: {} of {} rows in tension ('{}' above 1) have a negative stress. Tension is positive "
                    "here; is the sign of the load cell reversed?",
                    series.place(first, stress), negative, tensile, stretch.name));
}

void check_time(const Series& series, const Series::Column& column) {
  for (std::size_t row = 0; row < column.values.size(); ++row)
    if (column.values[row] < (row == 0 ? 0 : column.values[row - 1]))
      throw InputError(
          fmt::format("{}: the time {} s comes after {} s. Rows are in loading order, so time must not run "
                      "backwards, and begins at rest at 0.",
                      series.place(row, column), column.values[row], row == 0 ? 0 : column.values[row - 1]));
}

std::string some_lines(const std::vector<std::size_t>& lines) {
  const std::vector<std::size_t> shown(
      lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(lines.size(), 5)));
  return fmt::format("{} {}{}", lines.size() == 1 ? "line" : "lines", fmt::join(shown, ", "),
                     lines.size() > 5 ? ", …" : "");
}

/// Rows that repeat an earlier one in every mapped column, and, in a file that only loads (no cycle, no clock), rows
/// at an abscissa that was measured before with another result.
void check_duplicates(const Series& series, std::vector<std::string>& warnings) {
  bool clock = !series.time.empty();
  const Series::Column* abscissa = nullptr;
  std::map<std::vector<double>, std::size_t> rows, points;
  for (const Series::Column& column : series.columns) {
    clock = clock || column.observable->role == Role::time;
    if (column.observable->role == Role::abscissa && abscissa == nullptr) abscissa = &column;
  }
  std::vector<std::size_t> repeated, ambiguous;
  bool rising = true;
  for (std::size_t row = 0; row < series.lines.size(); ++row) {
    std::vector<double> all, prescribed;
    for (const Series::Column& column : series.columns) {
      all.push_back(std::isnan(column.values[row]) ? INFINITY : column.values[row]);  // a missing cell
      if (column.observable->role == Role::abscissa) prescribed.push_back(column.values[row]);
    }
    const bool new_row = rows.emplace(std::move(all), row).second;
    const bool new_point = points.emplace(std::move(prescribed), row).second;
    if (!new_row)
      repeated.push_back(series.lines[row]);
    else if (!new_point)
      ambiguous.push_back(series.lines[row]);
    if (row > 0 && abscissa != nullptr) rising = rising && abscissa->values[row] >= abscissa->values[row - 1];
  }
  if (abscissa == nullptr) return;  // nothing is prescribed: equal rows are equal measurements
  if (!repeated.empty() && (rising || clock))
    warnings.push_back(
        fmt::format("{}, {}: the same numbers as in an earlier row. Duplicates count twice in the fit; remove "
                    "them if they are not separate measurements.",
                    series.file.string(), some_lines(repeated)));
  if (!ambiguous.empty() && rising && !clock)
    warnings.push_back(
        fmt::format("{}, {}, column {} ('{}'): an earlier row has this abscissa and another result. A simulation "
                    "gives one value at both; is a time column missing, or are specimens mixed (\"where\")?",
                    series.file.string(), some_lines(ambiguous), abscissa->index + 1, abscissa->name));
}

}  // namespace

void check_series(const Series& series, std::vector<std::string>& warnings) {
  const Series::Column *stretch = nullptr, *abscissa = nullptr;
  for (const Series::Column& column : series.columns)
    if (column.observable->role == Role::abscissa && abscissa == nullptr) abscissa = &column;
  for (const Series::Column& column : series.columns)
    if (abscissa != nullptr && column.observable->role == Role::channel)
      check_straight(series, *abscissa, column, warnings);
  for (const Series::Column& column : series.columns) {
    if (column.observable->kind == Kind::stretch) check_stretch(series, column, warnings);
    if (column.observable->kind == Kind::stretch && column.observable->role == Role::abscissa && stretch == nullptr)
      stretch = &column;
    if (column.observable->role == Role::time) check_time(series, column);
  }
  for (const Series::Column& column : series.columns)
    if (stretch != nullptr && column.observable->kind == Kind::stress) check_sign(series, *stretch, column, warnings);
  check_duplicates(series, warnings);
}

}  // namespace tunica::data
