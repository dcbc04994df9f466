// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/anisotropy.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "text/units.hpp"

namespace tunica::diagnosis {
namespace {

using assembly::MeasuredChannel;

constexpr double sure_deviations = 5;
constexpr double same_stretch = 0.02;  ///< of the distance from 1

struct Difference {
  double stretch = 0, one = 0, other = 0, size = 0;  ///< size: of the range
};

double range_of(const MeasuredChannel& view) {
  double low = INFINITY, high = -INFINITY;
  for (const double value : view.measured)
    if (!std::isnan(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  return std::max(high - low, 1e-300);
}

/// The larger of two if it is large enough.
void keep(std::optional<Difference>& worst, Difference found, double sigma, double range, double tolerance) {
  const double gap = std::abs(found.one - found.other);
  found.size = gap / range;
  if (gap > sure_deviations * sigma && found.size > tolerance && (!worst || found.size > worst->size)) worst = found;
}

/// The direction that a name ends with: "circumferential" of "stress_circumferential"; empty where it has none.
std::string direction_in(const std::string& name) {
  for (const char* direction : {"circumferential", "axial"})
    if (name.ends_with(std::string("_") + direction)) return direction;
  return "";
}

/// The stretch along a direction, a value a row; null where the channel has none.
const std::vector<double>* stretch_along(const MeasuredChannel& view, const std::string& direction) {
  if (view.abscissa_name == "stretch_" + direction) return &view.abscissa;
  for (const auto& [title, values] : view.other_abscissae)
    if (title.starts_with("stretch_" + direction)) return &values;
  return nullptr;
}

/// A first loading: its rows by rising distance from rest.
using Points = std::vector<std::pair<double, double>>;

/// The rows that go further than all earlier ones: no unloading, no later cycle, no hold.
void add(Points& points, double stretch, double value) {
  constexpr double rest = 1;
  if (points.empty() || std::abs(stretch - rest) > std::abs(points.back().first - rest))
    points.emplace_back(stretch, value);
}

/// The value at a stretch on a rising curve, between neighbouring points; none outside.
std::optional<double> at(const Points& points, double stretch) {
  for (std::size_t k = 1; k < points.size(); ++k) {
    const auto& [a, low] = points[k - 1];
    const auto& [b, high] = points[k];
    if (stretch >= std::min(a, b) && stretch <= std::max(a, b)) return low + (high - low) * (stretch - a) / (b - a);
  }
  return std::nullopt;
}

/// The largest difference between two curves at equal stretches. Rows of one direction may lie between those of the
/// other.
std::optional<Difference> difference(const MeasuredChannel& around, const Points& first, const MeasuredChannel& along,
                                     const Points& second, double tolerance) {
  std::optional<Difference> worst;
  if (first.empty() || second.empty()) return worst;
  const double range = std::max(range_of(around), range_of(along));
  const std::vector<double> a = row_deviations(around), b = row_deviations(along);
  if (a.empty() || b.empty()) return worst;
  const double sigma = std::hypot(*std::max_element(a.begin(), a.end()), *std::max_element(b.begin(), b.end()));
  for (const auto& [stretch, value] : first)
    if (const auto other = at(second, stretch)) keep(worst, {stretch, value, *other}, sigma, range, tolerance);
  return worst;
}

/// Of a sheet: the fitted rows in which both stretches are the same.
Points equally_stretched(const MeasuredChannel& view) {
  const auto *first = stretch_along(view, "circumferential"), *second = stretch_along(view, "axial");
  Points points;
  if (first == nullptr || second == nullptr) return points;
  for (std::size_t row = 0; row < view.count; ++row)
    if (const double u = (*first)[row], v = (*second)[row];
        view.fitted[row] && std::abs(u - v) <= same_stretch * std::abs(u - 1))
      add(points, u, view.measured[row]);
  return points;
}

/// Of a strip: its fitted rows.
Points pulled(const MeasuredChannel& view) {
  Points points;
  for (std::size_t row = 0; row < view.count; ++row)
    if (view.fitted[row]) add(points, view.abscissa[row], view.measured[row]);
  return points;
}

}  // namespace

std::string anisotropy_words(const Evidence& evidence, double tolerance) {
  const auto& channels = evidence.base->layout().channels;
  std::optional<Difference> worst;
  std::string where, unit;
  const auto consider = [&](std::optional<Difference> found, std::string words, const std::string& of) {
    if (!found || (worst && found->size <= worst->size)) return;
    worst = found;
    where = std::move(words);
    unit = of;
  };
  const auto strip_direction = [&](const MeasuredChannel& view) {
    const experiment::TestEntry& test = evidence.experiment.test(view.test);
    return test.type == evidence.experiment.test(channels.front().test).type && test.options.has("direction")
               ? test.options.text("direction")
               : std::string();
  };
  for (const MeasuredChannel& around : channels)
    for (const MeasuredChannel& along : channels) {
      if (around.test == along.test && direction_in(around.observable) == "circumferential" &&
          direction_in(along.observable) == "axial")
        consider(difference(around, equally_stretched(around), along, equally_stretched(along), tolerance),
                 fmt::format("in the test '{}'", around.test), around.unit);
      if (around.test != along.test && around.observable == along.observable &&
          strip_direction(around) == "circumferential" && strip_direction(along) == "axial")
        consider(difference(around, pulled(around), along, pulled(along), tolerance),
                 fmt::format("in the tests '{}' and '{}'", around.test, along.test), around.unit);
    }
  if (!worst) return "";
  return fmt::format(
      "two directions answer differently: at stretch {:.3g} in both, {:.3g} and {:.3g}{} along the circumference and "
      "the "
      "axis, {}; the base has no directions",
      worst->stretch, worst->one, worst->other, text::unit_suffix(unit), where);
}

}  // namespace tunica::diagnosis
