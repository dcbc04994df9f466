// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/outlines.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace tunica::cohort_diagnosis {
namespace {

constexpr std::size_t points = 9;
constexpr std::size_t fewest = 3;  ///< specimens that have a spread

/// Between neighbours of rising abscissae; the ends beyond them.
double between(const std::vector<std::pair<double, double>>& curve, double x) {
  const auto above =
      std::lower_bound(curve.begin(), curve.end(), x,
                       [](const std::pair<double, double>& point, double at) { return point.first < at; });
  if (above == curve.begin()) return curve.front().second;
  if (above == curve.end()) return curve.back().second;
  const auto& [a, low] = *(above - 1);
  const auto& [b, high] = *above;
  return low + (high - low) * (x - a) / (b - a);
}

/// The measured rows on the way to the first turn, by rising abscissa.
std::vector<std::pair<double, double>> first_loading(const assembly::MeasuredChannel& view) {
  std::vector<std::pair<double, double>> curve;
  for (std::size_t row = 0; row < view.count; ++row) {
    if (!view.fitted[row]) continue;
    const double x = view.abscissa[row];
    const bool turns = curve.size() > 1 && (x - curve.back().first) * (curve.back().first - curve.front().first) < 0;
    if (turns) break;
    if (curve.empty() || x != curve.back().first) curve.emplace_back(x, view.measured[row]);
  }
  std::sort(curve.begin(), curve.end());
  return curve;
}

std::vector<std::pair<double, double>> points_of(const Outline& outline) {
  std::vector<std::pair<double, double>> curve;
  for (std::size_t k = 0; k < outline.values.size(); ++k)
    curve.emplace_back(outline.from + (outline.to - outline.from) * static_cast<double>(k) / (points - 1),
                       outline.values[k]);
  return curve;
}

/// Σ over abscissae of the variance between curves, over their number and the square of the range.
std::optional<double> relative_variance(const std::vector<const Outline*>& curves) {
  double from = -INFINITY, to = INFINITY, range = 0;
  for (const Outline* one : curves) {
    from = std::max(from, one->from);
    to = std::min(to, one->to);
    range += one->range / static_cast<double>(curves.size());
  }
  if (curves.size() < fewest || !(to > from) || !(range > 0)) return std::nullopt;
  double sum = 0;
  for (std::size_t k = 0; k < points; ++k) {
    const double x = from + (to - from) * static_cast<double>(k) / (points - 1);
    const auto n = static_cast<double>(curves.size());
    std::vector<double> values;
    double mean = 0, squares = 0;
    for (const Outline* one : curves) {
      values.push_back(between(points_of(*one), x));
      mean += values.back() / n;
    }
    for (const double value : values) squares += (value - mean) * (value - mean);
    sum += squares / (n - 1) / points;
  }
  return sum / (range * range);
}

}  // namespace

std::vector<Outline> outlines_of(const diagnosis::Evidence& evidence) {
  std::vector<Outline> outlines;
  for (const diagnosis::ChannelSize& size : diagnosis::MisfitSize(evidence).channels(evidence.fit)) {
    Outline one{size.test, size.channel, size.rows, size.range, size.of_range().rms, 0, 0, {}};
    for (const auto& view : evidence.base->layout().channels)
      if (view.test == one.test && view.observable == one.channel) {
        const auto curve = first_loading(view);
        if (curve.size() < 2) continue;
        one.from = curve.front().first;
        one.to = curve.back().first;
        for (std::size_t k = 0; k < points; ++k)
          one.values.push_back(between(curve, one.from + (one.to - one.from) * static_cast<double>(k) / (points - 1)));
      }
    outlines.push_back(std::move(one));
  }
  return outlines;
}

std::optional<double> spread_between(std::span<const std::vector<Outline>* const> specimens) {
  std::map<std::pair<std::string, std::string>, std::vector<const Outline*>> curves;
  for (const std::vector<Outline>* specimen : specimens)
    for (const Outline& one : *specimen)
      if (!one.values.empty()) curves[{one.test, one.channel}].push_back(&one);
  double sum = 0, count = 0;
  for (const auto& [name, of_curve] : curves)
    if (const auto variance = relative_variance(of_curve)) {
      sum += *variance;
      ++count;
    }
  if (count == 0) return std::nullopt;
  return std::sqrt(sum / count);
}

}  // namespace tunica::cohort_diagnosis
