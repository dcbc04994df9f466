// SPDX-License-Identifier: Apache-2.0
#include "comparison/neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

namespace tunica::comparison {
namespace {

struct Point {
  double x, y, e;
};

/// The points of each step of one channel.
std::vector<std::vector<Point>> frames_of(const assembly::MeasuredChannel& view,
                                          const std::vector<double>& predictions) {
  const std::vector<double>&x = *view.coordinate("x"), &y = *view.coordinate("y");
  const std::vector<double>* const step = view.coordinate("step");
  std::map<double, std::vector<Point>> frames;
  for (std::size_t i = 0, k = 0; i < view.count; ++i) {
    if (!view.fitted[i]) continue;
    const double e = (predictions[view.offset + i] - view.measured[i]) / view.sigma.rows.sd[k++];
    if (std::isfinite(x[i]) && std::isfinite(y[i])) frames[step != nullptr ? (*step)[i] : 0].push_back({x[i], y[i], e});
  }
  std::vector<std::vector<Point>> all;
  for (auto& [value, points] : frames) all.push_back(std::move(points));
  return all;
}

/// Sums over the pairs of points that lie within one range of distances.
struct Ring {
  double products = 0;
  std::size_t pairs = 0;
};

}  // namespace

Neighbours neighbours(const assembly::Assembly& assembly, const std::string& test,
                      const std::vector<double>& predictions) {
  constexpr std::size_t most = 40;  // rings, each as wide as nearest points are apart
  Neighbours found;
  double squares = 0, products = 0;
  std::array<Ring, most> rings{};
  for (const assembly::MeasuredChannel& view : assembly.layout().channels) {
    if (view.test != test || !view.is_field() || !(view.weight > 0) || view.sigma.rows.sd.empty()) continue;
    if (!view.observable.starts_with("u")) continue;  // forces have no place
    for (const std::vector<Point>& points : frames_of(view, predictions)) {
      std::vector<double> nearest(points.size(), INFINITY);
      std::vector<double> its(points.size(), 0);
      for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < points.size(); ++j) {
          const double d = std::hypot(points[i].x - points[j].x, points[i].y - points[j].y);
          if (i == j || d >= nearest[i]) continue;
          nearest[i] = d;
          its[i] = points[j].e;
        }
      if (points.size() < 2) continue;
      std::vector<double> sorted = nearest;
      const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
      std::nth_element(sorted.begin(), middle, sorted.end());
      for (std::size_t i = 0; i < points.size(); ++i) {
        products += points[i].e * its[i];
        squares += points[i].e * points[i].e;
        for (std::size_t j = 0; j < i; ++j) {
          const double d = std::hypot(points[i].x - points[j].x, points[i].y - points[j].y) / *middle - 0.5;
          const auto ring = static_cast<std::size_t>(std::max(d, 0.0));
          if (!(d < most)) continue;
          rings[ring].products += points[i].e * points[j].e;
          ++rings[ring].pairs;
        }
      }
      found.points += points.size();
    }
  }
  if (found.points == 0 || !(squares > 0)) return {};
  const double n = static_cast<double>(found.points), variance = squares / n;
  found.nearest = products / squares;
  found.deviation = std::sqrt(2 / n);  // most pairs are each other's nearest
  for (const Ring& ring : rings) {
    if (ring.pairs == 0) continue;
    const double pairs = static_cast<double>(ring.pairs), rho = ring.products / pairs / variance;
    if (rho < 2 / std::sqrt(pairs)) break;
    found.inflation += 2 * pairs / n * rho;
  }
  return found;
}

void warn_of_neighbours(const assembly::Assembly& assembly, const std::vector<double>& predictions,
                        const std::string& label, std::vector<execution::Warning>& warnings) {
  std::set<std::string> fields;
  for (const assembly::MeasuredChannel& view : assembly.layout().channels)
    if (view.is_field()) fields.insert(view.test);
  for (const std::string& test : fields) {
    const Neighbours found = neighbours(assembly, test, predictions);
    if (!found.err_together()) continue;
    const double factor = std::sqrt(found.inflation);
    warnings.push_back(
        {execution::WarningKind::noise_contradicted,
         fmt::format(
             "the points of '{}' err together: residuals of nearest points correlate by {:.2f} (0 where each errs "
             "by itself), and {} of them count as {:.0f}. So intervals are too narrow by about {:.2g} times. "
             "Space points at least one subset apart, or state {:.2g} times the noise. A model that misses the "
             "field does the same: `tunica diagnose` says whether",
             test, found.nearest, found.points, static_cast<double>(found.points) / found.inflation, factor, factor),
         label,
         {test}});
  }
}

}  // namespace tunica::comparison
