// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "data/record.hpp"

namespace tunica::data {
namespace {

/// A straight line through some rows.
struct Tangent {
  double slope = 0, error = 0;  ///< of the line, and its standard error
  std::size_t first = 0;        ///< row
};

Tangent tangent(const std::vector<double>& x, const std::vector<double>& y, const std::vector<std::size_t>& rows) {
  const auto n = static_cast<double>(rows.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, rest = 0;
  for (const std::size_t row : rows) {
    mean_x += x[row] / n;
    mean_y += y[row] / n;
  }
  for (const std::size_t row : rows) {
    xx += (x[row] - mean_x) * (x[row] - mean_x);
    xy += (x[row] - mean_x) * (y[row] - mean_y);
  }
  const double slope = xy / xx;
  for (const std::size_t row : rows) rest += std::pow(y[row] - mean_y - slope * (x[row] - mean_x), 2);
  return {slope, std::sqrt(rest / (n - 2) / xx), rows.front()};
}

}  // namespace

void look_for_softening(const Series& series, std::vector<Finding>& findings) {
  // Rubber softens from the first window on, and stiffens later; what stiffens first and then softens is no longer the
  // specimen that was mounted. The errors are those of a line where the curve bends, so that they err to the safe side.
  constexpr std::size_t windows = 8, fewest = 4, earliest = 2;
  constexpr double fallen = 0.33, certain = 4;
  const Series::Column* path = nullptr;
  for (const Series::Column& column : series.columns) {
    if (column.observable->role != Observable::Role::abscissa) continue;
    if (path != nullptr || column.observable->kind != Observable::Kind::stretch) return;  // a held one decides too
    path = &column;
  }
  if (path == nullptr || path->values.size() < windows * fewest) return;
  const std::vector<double>& x = path->values;
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  const double range = *high - *low;
  if (!(range > 0) || !(*low > 0.95)) return;  // pulled; compression is left to the eye
  double way = 0;
  for (std::size_t row = 1; row < x.size(); ++row) way += std::abs(x[row] - x[row - 1]);
  if (!(way < 1.1 * range)) return;  // one way only
  for (const Series::Column& stress : series.columns) {
    if (stress.observable->role != Observable::Role::channel || stress.observable->kind != Observable::Kind::stress)
      continue;
    std::array<std::vector<std::size_t>, windows> rows;
    bool whole = true;
    for (std::size_t row = 0; row < x.size(); ++row) {
      whole = whole && std::isfinite(stress.values[row]);
      const auto window = static_cast<std::size_t>((x[row] - *low) / range * windows);
      rows[std::min(window, windows - 1)].push_back(row);
    }
    whole = whole && std::all_of(rows.begin(), rows.end(), [](const auto& some) { return some.size() >= fewest; });
    if (!whole) continue;
    std::array<Tangent, windows> tangents;
    for (std::size_t k = 0; k < windows; ++k) tangents[k] = tangent(x, stress.values, rows[k]);
    const auto steepest = std::max_element(tangents.begin(), tangents.end(),
                                           [](const Tangent& a, const Tangent& b) { return a.slope < b.slope; });
    const Tangent& last = tangents.back();
    if (steepest - tangents.begin() < static_cast<std::ptrdiff_t>(earliest)) continue;
    if (!(last.slope < fallen * steepest->slope)) continue;
    if (!(steepest->slope - last.slope > certain * std::hypot(steepest->error, last.error))) continue;
    findings.push_back(
        {FindingKind::record_softening,
         fmt::format(
             "{}: the stiffness rises to {:.3g} {} and then falls to {:.3g} {} at the end. Did the specimen slip, "
             "yield or begin to tear? Elastic models of tissue do not bend so. Leave the rows after it out with "
             "\"rows\", or say so with a mechanism of damage",
             series.place(steepest->first, stress), steepest->slope, stress.observable->unit, last.slope,
             stress.observable->unit)});
  }
}

}  // namespace tunica::data
