// SPDX-License-Identifier: Apache-2.0
#include "wall.hpp"

#include <numbers>

namespace tunica::thick_wall {

Wall::Wall(const Tube& tube, std::span<const double> own)
    : Ro(tube.outer_radius), interface(tube.layer_interface), tether(own[tethering]) {
  // Null by null, so that nothing but the bare tube is computed there.
  const double thickness = tube.outer_radius - tube.inner_radius, error = own[thickness_error];
  Ri = error == 0 ? tube.inner_radius : Ro - thickness * (1 + error);
  V = Ro * Ro - Ri * Ri;
  area_by_error = 2 * Ri * thickness;

  constexpr double turn = 360;
  const double left = turn - own[opening_angle];
  K = own[opening_angle] == 0 ? 1 : turn / left;
  closing_by_angle = turn / (left * left);
  iota = std::log(own[opening_angle] == 0 ? Ri : 0.5 * (K * (Ro + Ri) - (Ro - Ri)));

  // Inner layer ρ s, outer layer s, with the mean over the thickness f ρ s + (1 − f) s = 1.
  const double ratio = own[layer_ratio], f = interface, mean = f * ratio + (1 - f);
  if (ratio != 1) inner = ratio / mean, outer = 1 / mean;
  inner_by_ratio = (1 - f) / (mean * mean), outer_by_ratio = -f / (mean * mean);
}

}  // namespace tunica::thick_wall
