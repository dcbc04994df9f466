// SPDX-License-Identifier: Apache-2.0
#include "wall.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/detail/solve_strip.hpp"

namespace tunica::ring {

using std::numbers::pi;

Status Wall::pull(const Model& model, std::span<const double> parameters, std::span<const double> at,
                  bool by_parameters, Strips& strips, std::size_t& lost) {
  const std::size_t n = at.size(), columns = by_parameters ? parameters.size() : 0;
  strips.stress.resize(n);
  strips.y.resize(n);
  strips.stress_by_l.resize(n);
  strips.y_by_l.resize(n);
  strips.stress_dp.resize(columns * n);
  strips.y_dp.resize(columns * n);
  constexpr std::size_t circumferential = 0;
  return free_strip::solve(model,
                           {.loaded = circumferential,
                            .parameters = parameters,
                            .stretch = at,
                            .stress = strips.stress,
                            .lateral = strips.y,
                            .stress_dp = strips.stress_dp,
                            .lateral_dp = strips.y_dp,
                            .stress_by_l = strips.stress_by_l,
                            .lateral_by_l = strips.y_by_l,
                            .lost = &lost},
                           scratch_);
}

/// Newton's method on g(λ) = 2π Rc λ − 2 d − 2π a − π H λr(λ), all rows at once; λr = 1/(λ λ2) falls as λ grows.
Status Wall::find_centreline(const Model& model, std::span<const double> parameters, std::span<const double> distance,
                             bool derivatives, std::size_t& lost) {
  constexpr int most = 30;
  constexpr double last_step = 1e-9;  // what it leaves is its square
  const std::size_t n = distance.size();
  const double around = 2 * pi * ring_.centre(), pins = 2 * pi * ring_.pin_radius, wall = pi * ring_.thickness;
  stretch.resize(n);
  thinning.resize(n);
  stretch_by_distance.resize(n);
  for (std::size_t i = 0; i < n; ++i) stretch[i] = (2 * distance[i] + pins + wall) / around;
  Strips centre;
  for (int iteration = 0; iteration < most; ++iteration) {
    const bool done = iteration > 0 && lost == StripPath::none;
    if (Status status = pull(model, parameters, stretch, derivatives, centre, lost); !status.ok()) return status;
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double thin = 1 / (stretch[i] * std::exp(0.5 * centre.y[i]));
      const double slope = around + wall * thin * (1 + 0.5 * centre.y_by_l[i]) / stretch[i];
      const double step = -(around * stretch[i] - 2 * distance[i] - pins - wall * thin) / slope;
      if (!(slope > 0) || !std::isfinite(step)) {
        lost = i;
        return Status::failed("the energy overflows");
      }
      thinning[i] = thin;
      stretch_by_distance[i] = 2 / slope;
      largest = std::max(largest, std::abs(step));
      stretch[i] += std::clamp(step, -0.5 * stretch[i], 0.5 * stretch[i]);
    }
    if (largest < last_step && done) break;
    if (iteration + 1 == most) {
      lost = 0;
      return Status::failed("the thinning of the wall does not settle");
    }
  }
  stretch_dp.resize(centre.stress_dp.size());
  for (std::size_t j = 0; j * n < stretch_dp.size(); ++j)  // dλr = −½ λr dy at the same λ
    for (std::size_t i = 0; i < n; ++i)
      stretch_dp[j * n + i] = -0.5 * wall * thinning[i] * centre.y_dp[j * n + i] * 0.5 * stretch_by_distance[i];
  return {};
}

Status Wall::solve(const Model& model, std::span<const double> parameters, std::span<const double> distance,
                   bool derivatives, std::size_t& lost) {
  lost = StripPath::none;
  if (Status status = find_centreline(model, parameters, distance, derivatives, lost); !status.ok()) return status;
  const std::size_t n = distance.size();
  force.assign(n, 0);
  force_by_distance.assign(n, 0);
  force_dp.assign(derivatives ? parameters.size() * n : 0, 0);
  std::vector<double> layer(n);
  Strips strips;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const double share = ring_.centre() / (ring_.inner_radius + places_[k] * ring_.thickness);
    for (std::size_t i = 0; i < n; ++i) layer[i] = stretch[i] * share;
    if (Status status = pull(model, parameters, layer, derivatives, strips, lost); !status.ok()) return status;
    const double area = 2 * ring_.width * ring_.thickness * weights_[k];
    for (std::size_t i = 0; i < n; ++i) {
      // P = σ/λ of the layer; its logarithmic stretch moves with that of the centreline.
      const double by_stretch = area * (strips.stress_by_l[i] - strips.stress[i]) / (layer[i] * stretch[i]);
      force[i] += area * strips.stress[i] / layer[i];
      force_by_distance[i] += by_stretch * stretch_by_distance[i];
      for (std::size_t j = 0; j * n < force_dp.size(); ++j)
        force_dp[j * n + i] += area * strips.stress_dp[j * n + i] / layer[i] + by_stretch * stretch_dp[j * n + i];
    }
  }
  return {};
}

}  // namespace tunica::ring
