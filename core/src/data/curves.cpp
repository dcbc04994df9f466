// SPDX-License-Identifier: Apache-2.0
#include "data/curves.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace tunica::data {
namespace {

constexpr double held_within = 0.02;       ///< of the range of the held quantity, over the rows of one curve
constexpr double swept_at_least = 0.1;     ///< of the range of the swept quantity, over the rows of one curve
constexpr std::size_t rows_of_curve = 3;   ///< on average; fewer are no curves
constexpr std::size_t rows_of_pass = 4;    ///< on average between two turns; fewer are no path
constexpr double turn = 0.02, jump = 0.2;  ///< of the range of the abscissa
constexpr double ordinary_steps = 4;       ///< a jump is that much longer than the median step

struct Extent {
  double low = INFINITY, high = -INFINITY, way = 0;
  [[nodiscard]] double range() const { return high - low; }
  [[nodiscard]] bool varies() const { return range() > 1e-3 * std::max(std::abs(low), std::abs(high)); }
  /// How often it goes through its range: 1 for one pass.
  [[nodiscard]] double passes() const { return way / range(); }
};

Extent extent(std::span<const double> values) {
  Extent found;
  double last = NAN;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    found.low = std::min(found.low, value);
    found.high = std::max(found.high, value);
    found.way += std::isfinite(last) ? std::abs(value - last) : 0;
    last = value;
  }
  return found;
}

/// The first rows of the stretches of rows over which a quantity keeps its value.
std::vector<std::size_t> holds(std::span<const double> values, double tolerance) {
  std::vector<std::size_t> first;
  for (std::size_t row = 0; row < values.size(); ++row)
    if (first.empty() || !(std::abs(values[row] - values[first.back()]) <= tolerance)) first.push_back(row);
  return first;
}

/// How many rows stand in long rests.
std::size_t rows_at_rest(std::span<const double> values) {
  constexpr double longer = 3;
  constexpr std::size_t fewest = 4;
  const Extent all = extent(values);
  if (!all.varies()) return values.size();
  const auto first = holds(values, held_within * all.range());
  const double ramp = held_within * static_cast<double>(values.size());
  std::size_t rows = 0;
  for (std::size_t k = 0; k < first.size(); ++k) {
    const std::size_t count = (k + 1 < first.size() ? first[k + 1] : values.size()) - first[k];
    if (count >= fewest && static_cast<double>(count) > longer * ramp) rows += count;
  }
  return rows;
}

/// The first rows of the curves of a family: `held` keeps its value along each, and `swept` varies along most rows.
std::vector<std::size_t> family(std::span<const double> held, std::span<const double> swept) {
  auto first = holds(held, held_within * extent(held).range());
  if (first.size() < 2 || held.size() < rows_of_curve * first.size()) return {};
  const double all = extent(swept).range();
  std::size_t covered = 0;
  for (std::size_t k = 0; k < first.size(); ++k) {
    const std::size_t end = k + 1 < first.size() ? first[k + 1] : held.size();
    if (extent(swept.subspan(first[k], end - first[k])).range() > swept_at_least * all) covered += end - first[k];
  }
  return 2 * covered > held.size() ? first : std::vector<std::size_t>{};
}

std::vector<std::string> names(const Prescribed& held, const std::vector<std::size_t>& first) {
  std::vector<std::string> curves;
  const bool no_unit = held.unit.empty() || held.unit == "1" || held.unit == "-";
  for (std::size_t k = 0; k < first.size(); ++k) {
    const std::size_t end = k + 1 < first.size() ? first[k + 1] : held.values.size();
    auto values = std::vector<double>(held.values.begin() + static_cast<std::ptrdiff_t>(first[k]),
                                      held.values.begin() + static_cast<std::ptrdiff_t>(end));
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    curves.insert(curves.end(), values.size(),
                  fmt::format("{} = {:.4g}{}", held.name, *middle, no_unit ? "" : " " + held.unit));
  }
  return curves;
}

/// Whether the rows go to and fro in passes of several rows.
bool is_path(std::span<const double> abscissa, const std::vector<std::size_t>& rows, double range) {
  std::size_t turns = 0;
  double extreme = abscissa[rows.front()];
  int direction = 0;
  for (const std::size_t row : rows) {
    const double step = abscissa[row] - extreme;
    if (direction * step > 0) extreme = abscissa[row];
    if (direction * step >= 0 && direction != 0) continue;
    if (std::abs(step) <= turn * range) continue;
    turns += direction == 0 ? 0 : 1;
    direction = step > 0 ? 1 : -1;
    extreme = abscissa[row];
  }
  return (turns + 1) * rows_of_pass <= rows.size() || turns == 0;
}

double median_step(std::span<const double> abscissa) {
  std::vector<double> steps;
  for (std::size_t row = 1; row < abscissa.size(); ++row)
    if (const double step = std::abs(abscissa[row] - abscissa[row - 1]); std::isfinite(step)) steps.push_back(step);
  if (steps.empty()) return INFINITY;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

}  // namespace

Abscissa abscissa_of(std::span<const Prescribed> prescribed, const std::string& own) {
  Abscissa chosen;
  std::vector<std::size_t> varying;
  std::vector<Extent> extents;
  for (std::size_t k = 0; k < prescribed.size(); ++k) {
    extents.push_back(extent(prescribed[k].values));
    if (extents.back().varies()) varying.push_back(k);
  }
  std::vector<std::size_t> fewest;
  std::size_t held = 0;
  for (const std::size_t over : varying)
    for (const std::size_t other : varying) {
      if (over == other) continue;
      auto first = family(prescribed[other].values, prescribed[over].values);
      if (first.empty() || (!fewest.empty() && first.size() >= fewest.size())) continue;
      fewest = std::move(first);
      chosen.column = over;
      held = other;
    }
  if (!fewest.empty()) {
    chosen.curves = names(prescribed[held], fewest);
    return chosen;
  }
  double least = INFINITY;
  for (const std::size_t k : varying) {
    // A quantity before another one is left only for one that is clearly straighter.
    if (extents[k].passes() > least / 1.5) continue;
    chosen.column = k;
    least = extents[k].passes();
  }
  for (const std::size_t k : varying)
    if (prescribed[k].name == own && extents[k].passes() <= 3 * least) chosen.column = k;
  return chosen;
}

bool is_over_time(std::span<const Prescribed> prescribed, std::span<const double> time) {
  if (time.empty() || prescribed.empty()) return false;
  return std::all_of(prescribed.begin(), prescribed.end(),
                     [](const Prescribed& one) { return 2 * rows_at_rest(one.values) > one.values.size(); });
}

std::vector<Line> lines_of(std::span<const double> abscissa, std::span<const std::string> curves) {
  std::vector<std::vector<std::size_t>> members;  // the rows of each curve, one after another
  for (std::size_t row = 0; row < abscissa.size(); ++row) {
    if (!std::isfinite(abscissa[row])) continue;
    if (members.empty() || (!curves.empty() && curves[row] != curves[members.back().back()])) members.emplace_back();
    members.back().push_back(row);
  }
  const double range = extent(abscissa).range();
  const double far = std::max(jump * range, ordinary_steps * median_step(abscissa));
  std::vector<Line> lines;
  for (auto& rows : members) {
    const std::string curve = curves.empty() ? "" : curves[rows.front()];
    if (!is_path(abscissa, rows, range)) {
      std::stable_sort(rows.begin(), rows.end(), [&](auto a, auto b) { return abscissa[a] < abscissa[b]; });
      lines.push_back({curve, std::move(rows), false});
      continue;
    }
    lines.push_back({curve, {}, true});
    double before = 0;  // the last step: rows of a relaxation are farther and farther apart, and one line
    for (const std::size_t row : rows) {
      const double step = lines.back().rows.empty() ? 0 : abscissa[row] - abscissa[lines.back().rows.back()];
      if (std::abs(step) > far && !(step * before > 0)) lines.push_back({curve, {}, true});
      before = step;
      lines.back().rows.push_back(row);
    }
  }
  return lines;
}

}  // namespace tunica::data
