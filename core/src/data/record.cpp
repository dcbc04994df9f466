// SPDX-License-Identifier: Apache-2.0
#include "data/record.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "data/nearest.hpp"
#include "data/quantities.hpp"
#include "text/units.hpp"

namespace tunica::data {
namespace {

using Role = Observable::Role;
using Kind = Observable::Kind;

double state_of_rest(const Observable& observable) { return observable.kind == Kind::stretch ? 1 : 0; }

std::vector<const Series::Column*> columns_of(const Series& series, Role role) {
  std::vector<const Series::Column*> found;
  for (const Series::Column& column : series.columns)
    if (column.observable->role == role) found.push_back(&column);
  return found;
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

/// The one prescribed quantity; null where there are several, because a held one decides what the load means.
const Series::Column* only_abscissa(const Series& series) {
  const auto abscissae = columns_of(series, Role::abscissa);
  return abscissae.size() == 1 && all_finite(abscissae.front()->values) ? abscissae.front() : nullptr;
}

std::vector<const Series::Column*> stresses_of(const Series& series) {
  std::vector<const Series::Column*> found = columns_of(series, Role::channel);
  std::erase_if(found, [](const Series::Column* column) {
    return column->observable->kind != Kind::stress || !all_finite(column->values);
  });
  return found;
}

double largest_of(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

std::string with_base_unit(double value, const Series::Column& column) {
  return fmt::format("{:.4g}{}", value, text::unit_suffix(column.observable->unit));
}

/// How to leave rows [first, last) out: the numbers of "rows" count what "where", "cycle" and "branch" leave.
std::string left_out(const DataRequest& request, std::size_t first, std::size_t last, const Series& series) {
  const bool plain = request.rows.first == 0 && !request.rows.last && request.rows.step == 1 && !request.resample;
  if (plain && first == 0) return fmt::format("Leave it out with \"rows\": \"{}:\"", last);
  if (plain) return fmt::format("Leave them out with \"rows\": \"0:{}\"", first);
  return fmt::format("Leave {} line {} out with \"rows\"", first == 0 ? "what stands up to" : "what stands from",
                     series.lines[first == 0 ? last - 1 : first]);
}

std::string lower(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
  return small;
}

/// The word of the file that speaks of compression; empty = none.
std::string word_of_compression(const Series& series) {
  std::vector<std::string> names = {series.file.filename().string()};
  for (const Series::Column& column : series.columns) names.push_back(column.name);
  for (const std::string& name : names)
    for (const char* word : {"compress", "kompress", "stauch"})
      if (lower(name).find(word) != std::string::npos) return name;
  return {};
}

/// As thick as long, within a factor of three. Compressed specimens are squat; stretched ones are slender.
std::string stub_words(const Series::Column& stretch, const Specimen& specimen) {
  if (!(stretch.gauge_length > 0) || specimen.gauge_at_preload) return {};
  const Sizes sizes = sizes_along(specimen, stretch.observable->name);
  double thinnest = 0;
  if (specimen.area)
    thinnest = std::sqrt(*specimen.area);
  else if (sizes.width && specimen.thickness)
    thinnest = std::min(*sizes.width, *specimen.thickness);
  if (3 * thinnest <= stretch.gauge_length) return {};
  return fmt::format("the specimen is {:.3g} mm long and {:.3g} mm thick, as one to be pressed", stretch.gauge_length,
                     thinnest);
}

}  // namespace

void look_for_break(const Series& series, const DataRequest& request, std::vector<Finding>& findings) {
  constexpr std::size_t fewest = 8, sudden = 3;
  constexpr double bears = 0.75, collapsed = 0.5, gone = 0.1, moved = 0.005, returned = 0.02;
  const Series::Column* const path = only_abscissa(series);
  const std::size_t count = series.lines.size();
  if (path == nullptr || count < fewest) return;
  std::vector<double> distance;
  for (const double x : path->values) distance.push_back(std::abs(x - state_of_rest(*path->observable)));
  const double range = largest_of(distance);
  for (const Series::Column* const stress : stresses_of(series)) {
    const auto top = std::max_element(stress->values.begin(), stress->values.end(),
                                      [](double a, double b) { return std::abs(a) < std::abs(b); });
    const auto peak = static_cast<std::size_t>(top - stress->values.begin());
    const double largest = std::abs(*top), sign = *top < 0 ? -1 : 1;
    const auto load = [&](std::size_t row) { return sign * stress->values[row] / largest; };
    if (largest == 0 || peak < 2 || load(peak - 1) < collapsed || load(peak - 2) < collapsed) continue;  // a spike
    std::size_t after = count;  // the first of the rows at the end that bear little
    while (after > peak + 1 && load(after - 1) < collapsed) --after;
    if (after == count) continue;
    std::size_t last = after - 1;
    while (last > peak && load(last) < bears) --last;
    const double farthest = *std::max_element(distance.begin() + static_cast<std::ptrdiff_t>(after), distance.end());
    const bool stayed = distance[after] >= distance[last] - returned * range;
    const bool goes_on = farthest > distance[last] + moved * range;
    if (after - last > sudden || !stayed || (!goes_on && load(after) > gone)) continue;
    findings.push_back(
        {FindingKind::record_broken,
         fmt::format(
             "{}: '{}' falls from {} to {} within {} and does not come back, while '{}' stays at {:.4g} or goes "
             "on. Did the specimen break or slip? The {} from there on are still fitted. {}",
             series.place(after, *stress), stress->observable->name, with_base_unit(stress->values[last], *stress),
             with_base_unit(stress->values[after], *stress),
             after - last == 1 ? std::string("one row") : fmt::format("{} rows", after - last), path->observable->name,
             path->values[last], count - last - 1 == 1 ? std::string("row") : fmt::format("{} rows", count - last - 1),
             left_out(request, last + 1, count, series))});
  }
}

void look_at_start(const Series& series, const DataRequest& request, std::vector<Finding>& findings) {
  constexpr std::size_t fewest = 6;
  constexpr double at_rest = 0.01, matters = 0.1;
  const std::size_t count = series.lines.size();
  const auto abscissae = columns_of(series, Role::abscissa);
  if (abscissae.empty() || count < fewest) return;
  for (const Series::Column* const column : abscissae) {
    if (!all_finite(column->values)) return;
    const double rest = state_of_rest(*column->observable);
    double range = 0;
    for (const double x : column->values) range = std::max(range, std::abs(x - rest));
    if (std::abs(column->values.front() - rest) > at_rest * range) return;
  }
  for (const Series::Column* const stress : stresses_of(series)) {
    const std::vector<double>& y = stress->values;
    const double largest = largest_of(y), first = std::abs(y.front());
    if (largest == 0 || first <= matters * largest) continue;
    const bool spike = std::all_of(y.begin() + 1, y.begin() + 4,
                                   [&](double next) { return std::abs(next) < first - matters * largest; });
    const std::string what =
        fmt::format("{}: {} at {} = {:.4g}, where nothing is deformed; the largest is {}", series.place(0, *stress),
                    with_base_unit(y.front(), *stress), abscissae.front()->observable->name,
                    abscissae.front()->values.front(), with_base_unit(largest, *stress));
    findings.push_back(
        {FindingKind::record_jump,
         spike ? fmt::format("{}, and the next row has {}. Is it a spike of the start? {}", what,
                             with_base_unit(y[1], *stress), left_out(request, 0, 1, series))
               : fmt::format("{}. Was the load not tared, or is the specimen longer than its gauge length? Take the "
                             "load off, or give the length at which the load begins",
                             what)});
  }
}

void look_for_blocks(const Series& series, std::vector<Finding>& findings) {
  const std::size_t count = series.lines.size();
  if (count < 8 || columns_of(series, Role::abscissa).empty()) return;
  // Every row as a number: equal rows have equal ones.
  std::map<std::vector<double>, std::size_t> known;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < count; ++row) {
    std::vector<double> all;
    for (const Series::Column& column : series.columns)
      if (column.observable->role != Role::time)
        all.push_back(std::isnan(column.values[row]) ? INFINITY : column.values[row]);
    rows.push_back(known.emplace(std::move(all), known.size()).first->second);
  }
  // A plateau repeats rows too, so a window counts only where most of its rows differ.
  const std::size_t width = std::clamp<std::size_t>(count / 4, 4, 10);
  std::map<std::vector<std::size_t>, std::size_t> windows;
  std::size_t best = 0, best_row = 0, best_first = 0, run = 0, previous = 0;
  for (std::size_t row = 0; row + width <= count; ++row) {
    std::vector<std::size_t> window(rows.begin() + static_cast<std::ptrdiff_t>(row),
                                    rows.begin() + static_cast<std::ptrdiff_t>(row + width));
    const bool plain = std::set<std::size_t>(window.begin(), window.end()).size() <= width / 2 + 1;
    const auto [at, is_new] = windows.emplace(std::move(window), row);
    const bool repeats = !plain && !is_new && at->second + width <= row;
    run = !repeats ? 0 : run > 0 && at->second == previous + 1 ? run + 1 : 1;
    previous = at->second;
    if (run <= best) continue;
    best = run;
    best_row = row + 1 - run;
    best_first = at->second + 1 - run;
  }
  const std::size_t length = best == 0 ? 0 : best + width - 1;
  if (5 * length < count || best == 0) return;
  findings.push_back(
      {FindingKind::record_repeated,
       fmt::format("{}, lines {} to {}: the same {} rows, digit by digit, as lines {} to {}. Was a file appended to "
                   "itself? They count twice in the fit. Leave one of the blocks out with \"rows\"",
                   series.file.string(), series.lines[best_row], series.lines[best_row + length - 1], length,
                   series.lines[best_first], series.lines[best_first + length - 1])});
}

void look_at_resolution(const Series& series, std::vector<Finding>& findings) {
  constexpr std::size_t most = 30, rows_a_value = 4;
  for (const Series::Column& column : series.columns) {
    if (column.observable->role != Role::channel || column.grid.step == 0) continue;
    const double steps = std::round(column.grid.range / column.grid.step);
    if (steps < 2 || steps > most || column.grid.values * rows_a_value > series.lines.size()) continue;
    findings.push_back({FindingKind::record_coarse,
                        fmt::format("{}: the {} rows have only {} different values, {:.4g}{} apart over a range of "
                                    "{:.4g}. The device or the export rounds too coarsely: take a column with more "
                                    "digits, or state a noise of at least {:.2g}{}",
                                    series.header_place(column), series.lines.size(), column.grid.values,
                                    column.grid.step, text::unit_suffix(column.grid.unit), column.grid.range,
                                    column.grid.step / std::sqrt(12.0), text::unit_suffix(column.grid.unit))});
  }
}

void look_at_sign(const Series& series, const DataRequest& request, std::vector<Finding>& findings) {
  const Series::Column* const stretch = only_abscissa(series);
  if (stretch == nullptr || stretch->observable->kind != Kind::stretch || request.compression.said) return;
  const std::size_t count = series.lines.size();
  const auto shorter = static_cast<std::size_t>(
      std::count_if(stretch->values.begin(), stretch->values.end(), [](double x) { return x < 1; }));
  for (const Series::Column* const stress : stresses_of(series)) {
    const double largest = largest_of(stress->values);
    std::size_t pulled = 0, first = count;
    double sum = 0;
    for (std::size_t row = 0; row < count; ++row) {
      if (!(stretch->values[row] < 1)) continue;
      sum += stress->values[row];
      if (stress->values[row] > 0 && pulled++ == 0) first = row;
    }
    // What hangs slack bears next to nothing.
    if (2 * shorter > count && 2 * pulled > shorter && sum > 0.05 * largest * static_cast<double>(shorter)) {
      findings.push_back(
          {FindingKind::record_sign,
           fmt::format("{}: {} of {} rows in compression ('{}' below 1) have a positive stress. Tension is positive "
                       "here: turn the sign of the load with \"units\", for example \"{}\": \"-1 {}\"",
                       series.place(first, *stress), pulled, shorter, stretch->name, stress->name,
                       stress->unit.empty() ? stress->observable->unit : stress->unit)});
      return;
    }
    const std::size_t pressed = static_cast<std::size_t>(
        std::count_if(stress->values.begin(), stress->values.end(), [](double y) { return y < 0; }));
    if (10 * shorter > count || 2 * pressed > count) continue;
    const std::string word = word_of_compression(series);
    const std::string why =
        word.empty() ? stretch->derived && stress->derived ? stub_words(*stretch, request.specimen) : std::string()
                     : fmt::format("'{}' speaks of compression", excerpt(word));
    if (why.empty()) continue;
    const auto [low, high] = std::minmax_element(stretch->values.begin(), stretch->values.end());
    findings.push_back(
        {FindingKind::record_sign,
         fmt::format("{}: {}, and the rows are read as tension, stretch {:.4g} … {:.4g}. If the file counts "
                     "compression as positive, add \"compression\": \"positive\" to \"data\"; if it is tension, add "
                     "\"compression\": \"negative\"",
                     series.header_place(*stress), why, *low, *high)});
    return;
  }
}

void look_at_time(const Series& series, std::vector<Finding>& findings) {
  constexpr double shortest = 1, fastest = 1, slowest = 1e-7;  // s, 1/s
  const auto clocks = columns_of(series, Role::time);
  const std::vector<double>& time = clocks.empty() ? series.time : clocks.front()->values;
  if (time.size() < 3 || !all_finite(time)) return;
  const double duration = time.back() - time.front();
  if (!(duration > 0)) return;
  double way = 0;
  const Series::Column* path = nullptr;
  for (const Series::Column* const column : columns_of(series, Role::abscissa)) {
    if (column->observable->kind != Kind::stretch || !all_finite(column->values)) continue;
    double own = 0;
    for (std::size_t row = 1; row < column->values.size(); ++row)
      own += std::abs(column->values[row] - column->values[row - 1]);
    if (own <= way) continue;
    way = own;
    path = column;
  }
  const double rate = way / duration;
  const bool wrong_rate = path != nullptr && (rate > fastest || rate < slowest);
  if (duration >= shortest && !wrong_rate) return;
  const std::string place = clocks.empty() ? series.file.string() : series.header_place(*clocks.front());
  findings.push_back(
      {FindingKind::record_time,
       fmt::format(
           "{}: the {} rows take {:.3g} s{}. Is the unit of the time right? Where it is, what depends on the "
           "rate is that of a test as {} as this",
           place, series.lines.size(), duration,
           path == nullptr ? "" : fmt::format(", a mean rate of {:.3g} /s of '{}'", rate, path->observable->name),
           path != nullptr && rate < slowest ? "slow" : "fast")});
}

void look_at_reach(const Series& series, std::vector<Finding>& findings) {
  constexpr double hardly = 0.05, large = 1;
  const auto abscissae = columns_of(series, Role::abscissa);
  double reach = 0;
  bool stretches = !abscissae.empty();
  for (const Series::Column* const column : abscissae) {
    if (!all_finite(column->values)) return;
    stretches = stretches && column->observable->kind == Kind::stretch;
    for (const double x : column->values) reach = std::max(reach, std::abs(x - 1));
  }
  if (stretches && reach > 0 && reach < hardly) {
    const Series::Column& column = *abscissae.front();
    findings.push_back(
        {FindingKind::record_short,
         fmt::format("{}: every stretch lies within {:.2g} % of 1. So little shows a stiffness and hardly any "
                     "nonlinearity. Is the unit of the {} right?",
                     series.header_place(column), 100 * reach,
                     !column.derived           ? "stretch"
                     : column.gauge_length > 0 ? "displacement, or the gauge length,"
                                               : "strain")});
  }
  for (const Series::Column* const column : abscissae) {
    const bool strain = column->derived && column->observable->kind == Kind::stretch && column->gauge_length == 0;
    if (!strain || !column->unit.empty()) continue;
    const auto [low, high] = std::minmax_element(column->values.begin(), column->values.end());
    const double farthest = std::max(*high - 1, 1 - *low);
    if (farthest <= large) continue;
    findings.push_back(
        {FindingKind::record_percent,
         fmt::format(
             "{}: the strain has no unit, and as it is read the stretch goes to {:.4g}. Is it percent? Say with "
             "\"units\": {{\"{}\": \"%\"}}, or \"1\" where it is none",
             series.header_place(*column), farthest == *high - 1 ? *high : *low, column->name)});
  }
}

void look_at_record(const Series& series, const DataRequest& request, std::vector<Finding>& findings) {
  look_at_reach(series, findings);
  look_at_sign(series, request, findings);
  look_at_start(series, request, findings);
  look_for_break(series, request, findings);
  const bool broken = std::any_of(findings.begin(), findings.end(),
                                  [](const Finding& finding) { return finding.kind == FindingKind::record_broken; });
  if (!broken) look_for_softening(series, findings);
  look_for_blocks(series, findings);
  look_at_resolution(series, findings);
  look_at_time(series, findings);
}

}  // namespace tunica::data
