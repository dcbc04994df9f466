// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "discovery/set_fit.hpp"
#include "discovery/term_slope.hpp"

namespace tunica::discovery {
namespace {

constexpr std::size_t grid_points = 24;

/// A law at the parameters that bring it closest to a curve.
struct Closest {
  std::vector<double> shapes;
  double amplitude = 0, misfit = INFINITY;
};

/// Over the first shapes of the kind; an angle that is known stays.
Closest closest_to(const Subject& subject, const Kind& kind, const std::vector<double>& x,
                   const std::vector<double>& slopes, double theta) {
  Closest best;
  for (std::vector<double> shapes : combinations(kind)) {
    if (kind.family == "diagonal" && std::isfinite(theta)) shapes.back() = theta;
    std::vector<double> own{1};
    own.insert(own.end(), shapes.begin(), shapes.end());
    const std::vector<double> unit = term_slopes(subject, kind, own, x);
    double together = 0, length = 0, misfit = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      together += unit[i] * slopes[i];
      length += unit[i] * unit[i];
    }
    const double amplitude = length > 0 ? std::max(together / length, 0.0) : 0;
    for (std::size_t i = 0; i < x.size(); ++i) misfit += std::pow(slopes[i] - amplitude * unit[i], 2);
    if (misfit < best.misfit) best = {std::move(shapes), amplitude, misfit};
  }
  return best;
}

}  // namespace

std::optional<SetFit> Fitter::distilled(const SetFit& from, const KindPointer& law, double worth) const {
  const std::string words = law->invariant_words();
  std::vector<double> x, slopes(grid_points, 0.0);
  for (std::size_t i = 0; i < grid_points; ++i)
    x.push_back(law->least() +
                (law->reach.high - law->least()) * (static_cast<double>(i) + 0.5) / static_cast<double>(grid_points));
  std::vector<KindPointer> kinds{law};
  double theta = NAN;
  for (std::size_t k = 0; k < from.kinds.size(); ++k) {
    if (from.kinds[k]->invariant_words() != words) {
      kinds.push_back(from.kinds[k]);
      continue;
    }
    std::vector<double> own;
    for (const std::size_t j : parameters_of(from.set->terms()[k])) own.push_back(from.fit.free[j]);
    if (law->family == "diagonal") theta = own.back();
    const std::vector<double> of_term = term_slopes(subject_, *from.kinds[k], own, x);
    for (std::size_t i = 0; i < grid_points; ++i) slopes[i] += of_term[i];
  }
  auto found = bound(std::move(kinds));
  if (!found) return std::nullopt;
  const Closest closest = closest_to(subject_, *law, x, slopes, theta);
  std::vector<double> start = start_of(from, *found->set);
  const auto& parameters = found->set->assembly().layout().parameters;
  const auto set = [&](std::size_t j, double value) {
    start[j] = std::clamp(value, parameters[j].min, parameters[j].max);
  };
  for (std::size_t k = 0; k < found->kinds.size(); ++k) {
    if (found->kinds[k] != law) continue;
    const BoundTerm& term = found->set->terms()[k];
    set(term.amplitude, closest.amplitude);
    for (std::size_t s = 0; s < closest.shapes.size(); ++s) set(term.shapes[s], closest.shapes[s]);
  }
  return fitted(std::move(*found), start, worth);
}

}  // namespace tunica::discovery
