// SPDX-License-Identifier: Apache-2.0
#include "comparison/neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace tunica::comparison {
namespace {

constexpr double most_pairs = 2e8;

/// Pairs of points that lie within one range of distances.
struct Ring {
  double products = 0;
  std::size_t pairs = 0, distinct = 0;  ///< distinct: (i, j) and (j, i) are one
};

/// Sums over all frames. Rings are as wide as nearest points are apart.
struct Sums {
  double nearest = 0, squares = 0;  ///< of e_i times that of the point nearest to i, and of e_i²
  std::size_t centres = 0;          ///< points i
  std::array<Ring, 40> rings{};
};

double distance(const FieldPoint& a, const FieldPoint& b) {
  const double x = a.x - b.x, y = a.y - b.y;
  return std::sqrt(x * x + y * y);
}

/// Adds the pairs of every `stride`th point with all others.
void add_pairs(const FieldFrame& frame, std::size_t stride, Sums& sums) {
  const std::size_t n = frame.size();
  std::vector<double> nearest;
  for (std::size_t i = 0; i < n; i += stride) {
    double least = INFINITY, its = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const double d = distance(frame[i], frame[j]);
      if (i == j || !(d < least)) continue;
      least = d;
      its = frame[j].e;
    }
    nearest.push_back(least);
    sums.nearest += frame[i].e * its;
    sums.squares += frame[i].e * frame[i].e;
  }
  sums.centres += nearest.size();
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  for (std::size_t i = 0; i < n; i += stride)
    for (std::size_t j = 0; j < n; ++j) {
      const double d = distance(frame[i], frame[j]);
      const double place = d > 0 ? std::max(d / *middle - 0.5, 0.0) : 0;  // infinite where most points coincide
      if (i == j || !(place < static_cast<double>(sums.rings.size()))) continue;
      Ring& ring = sums.rings[static_cast<std::size_t>(place)];
      ring.products += frame[i].e * frame[j].e;
      ++ring.pairs;
      if (j > i || j % stride != 0) ++ring.distinct;
    }
}

/// Adds the points of each step of one channel.
void add_frames(const assembly::MeasuredChannel& view, const std::vector<double>& predictions,
                std::vector<FieldFrame>& frames) {
  const std::vector<double>&x = *view.coordinate("x"), &y = *view.coordinate("y");
  const std::vector<double>* const step = view.coordinate("step");
  std::map<double, FieldFrame> own;
  for (std::size_t i = 0, k = 0; i < view.count; ++i) {
    if (!view.fitted[i]) continue;
    const double e = (predictions[view.offset + i] - view.measured[i]) / view.sigma.rows.sd[k++];
    if (std::isfinite(x[i]) && std::isfinite(y[i])) own[step != nullptr ? (*step)[i] : 0].push_back({x[i], y[i], e});
  }
  for (auto& [value, points] : own) frames.push_back(std::move(points));
}

/// The displacements of one test.
struct Field {
  std::vector<FieldFrame> frames;
  bool noise_stated = true;
};

}  // namespace

Neighbours neighbours(const std::vector<FieldFrame>& frames) {
  Neighbours found;
  Sums sums;
  for (const FieldFrame& frame : frames) {
    if (frame.size() < 2) continue;
    const double n = static_cast<double>(frame.size());
    const double stride = std::ceil(n * n * static_cast<double>(frames.size()) / most_pairs);
    add_pairs(frame, static_cast<std::size_t>(std::clamp(stride, 1.0, n)), sums);
    found.points += frame.size();
  }
  if (!(sums.squares > 0)) return {};
  const double n = static_cast<double>(sums.centres), variance = sums.squares / n;
  found.nearest = sums.nearest / sums.squares;
  found.deviation = std::sqrt(2 / n);  // most pairs are each other's nearest
  for (const Ring& ring : sums.rings) {
    if (ring.pairs == 0) continue;
    const double pairs = static_cast<double>(ring.pairs), rho = ring.products / pairs / variance;
    if (rho < 2 / std::sqrt(static_cast<double>(ring.distinct))) break;
    found.inflation += pairs / n * rho;
  }
  return found;
}

execution::Warning neighbours_warning(const std::string& test, const Neighbours& found, bool noise_stated) {
  const double factor = std::sqrt(found.inflation);
  return execution::Warning{
      execution::WarningKind::noise_contradicted,
      fmt::format("the points of '{}' err together: residuals of nearest points correlate by {:.2f} (0 where each errs "
                  "by itself), and {} of them count as {:.0f}. So intervals are too narrow by about {:.2g} times. "
                  "Space points at least one subset apart, or state {}. A model that misses the field does the same: "
                  "`tunica diagnose` says whether",
                  test, found.nearest, found.points, static_cast<double>(found.points) / found.inflation, factor,
                  noise_stated ? fmt::format("{:.2g} times the noise", factor)
                               : fmt::format("a noise: {:.2g} times the scatter of two images of the unloaded specimen",
                                             factor)),
      "",
      {test}};
}

void warn_of_neighbours(const assembly::Assembly& assembly, const std::vector<double>& predictions,
                        const std::string& label, std::vector<execution::Warning>& warnings) {
  std::map<std::string, Field> fields;
  for (const assembly::MeasuredChannel& view : assembly.layout().channels) {
    if (!view.is_field() || !(view.weight > 0) || view.sigma.rows.sd.empty()) continue;
    if (!view.observable.starts_with("u")) continue;  // forces have no place
    Field& field = fields[view.test];
    add_frames(view, predictions, field.frames);
    field.noise_stated = field.noise_stated && view.sigma.stated();
  }
  for (const auto& [test, field] : fields) {
    const Neighbours found = neighbours(field.frames);
    if (!found.err_together()) continue;
    warnings.push_back(neighbours_warning(test, found, field.noise_stated));
    warnings.back().run = label;
  }
}

}  // namespace tunica::comparison
