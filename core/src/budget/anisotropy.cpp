// SPDX-License-Identifier: Apache-2.0
#include "budget/anisotropy.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "text/units.hpp"

namespace tunica::budget {
namespace {

using assembly::MeasuredChannel;

constexpr double deviations = 5;
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
  if (gap > deviations * sigma && found.size > tolerance && (!worst || found.size > worst->size)) worst = found;
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

std::optional<Difference> in_sheet(const MeasuredChannel& around, const MeasuredChannel& along, double tolerance) {
  const auto *first = stretch_along(around, "circumferential"), *second = stretch_along(around, "axial");
  std::optional<Difference> worst;
  if (first == nullptr || second == nullptr || around.count != along.count) return worst;
  const double range = std::max(range_of(around), range_of(along));
  const std::vector<double> a = diagnosis::row_deviations(around), b = diagnosis::row_deviations(along);
  if (a.empty() || b.empty()) return worst;
  const double sigma =
      std::hypot(*std::max_element(a.begin(), a.end()), *std::max_element(b.begin(), b.end()));
  for (std::size_t row = 0; row < around.count; ++row) {
    const double u = (*first)[row], v = (*second)[row];
    if (!around.fitted[row] || !along.fitted[row] || std::abs(u - v) > same_stretch * std::abs(u - 1)) continue;
    keep(worst, {(u + v) / 2, around.measured[row], along.measured[row]}, sigma, range, tolerance);
  }
  return worst;
}

/// Measured value at a stretch on a rising curve, between neighbouring rows; none outside.
std::optional<double> at(const MeasuredChannel& view, double stretch) {
  for (std::size_t row = 1; row < view.count; ++row) {
    const double a = view.abscissa[row - 1], b = view.abscissa[row];
    if (!(b > a) || stretch < a || stretch > b || !view.fitted[row] || !view.fitted[row - 1]) continue;
    return view.measured[row - 1] + (view.measured[row] - view.measured[row - 1]) * (stretch - a) / (b - a);
  }
  return std::nullopt;
}

std::optional<Difference> of_strips(const MeasuredChannel& around, const MeasuredChannel& along, double tolerance) {
  std::optional<Difference> worst;
  const double range = std::max(range_of(around), range_of(along));
  const std::vector<double> a = diagnosis::row_deviations(around), b = diagnosis::row_deviations(along);
  if (a.empty() || b.empty()) return worst;
  const double sigma =
      std::hypot(*std::max_element(a.begin(), a.end()), *std::max_element(b.begin(), b.end()));
  for (std::size_t row = 0; row < around.count; ++row)
    if (const auto other = at(along, around.abscissa[row]); other && around.fitted[row])
      keep(worst, {around.abscissa[row], around.measured[row], *other}, sigma, range, tolerance);
  return worst;
}

}  // namespace

std::string anisotropy_words(const diagnosis::Evidence& evidence, double tolerance) {
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
        consider(in_sheet(around, along, tolerance), fmt::format("in the test '{}'", around.test), around.unit);
      if (around.test != along.test && around.observable == along.observable &&
          strip_direction(around) == "circumferential" && strip_direction(along) == "axial")
        consider(of_strips(around, along, tolerance),
                 fmt::format("in the tests '{}' and '{}'", around.test, along.test), around.unit);
    }
  if (!worst) return "";
  return fmt::format(
      "two directions answer differently: at stretch {:.3g} in both, {:.3g} and {:.3g}{} along the circumference and the "
      "axis, {}; the base has no directions",
      worst->stretch, worst->one, worst->other, text::unit_suffix(unit), where);
}

}  // namespace tunica::budget
