// SPDX-License-Identifier: Apache-2.0
#include "wall.hpp"

#include <numbers>

namespace tunica::thick_wall {

Wall::Wall(const Tube& tube, std::span<const double> own)
    : Ro(tube.outer_radius), interfaces(tube.interfaces), layered(tube.layered), tether(own[tethering]) {
  // Each imperfection is skipped at its null, so only the bare tube is computed there.
  const double thickness = tube.outer_radius - tube.inner_radius, error = own[thickness_error];
  Ri = error == 0 ? tube.inner_radius : Ro - thickness * (1 + error);
  V = Ro * Ro - Ri * Ri;
  area_by_error = 2 * Ri * thickness;

  constexpr double turn = 360;
  const double left = turn - own[opening_angle];
  K = own[opening_angle] == 0 ? 1 : turn / left;
  closing_by_angle = turn / (left * left);
  iota = std::log(own[opening_angle] == 0 ? Ri : 0.5 * (K * (Ro + Ri) - (Ro - Ri)));

  if (layered) return;
  // Inner layer ρ s, outer layer s, with the mean over the thickness f ρ s + (1 − f) s = 1.
  const double ratio = own[layer_ratio], f = interfaces[0], mean = f * ratio + (1 - f);
  if (ratio != 1) {
    inner = ratio / mean;
    outer = 1 / mean;
  }
  inner_by_ratio = (1 - f) / (mean * mean);
  outer_by_ratio = -f / (mean * mean);
}

/// A fraction f of the sector's thickness is at R = (1 − f) R_i + f R_o. The radius R_f = (1 − f) Ri + f Ro of the
/// unloaded wall, with Ri² = Ro² − V, was at R² = R_i² + K (R_f² − Ri²) in the sector: the area between is kept.
void Wall::edges(std::vector<Jet>& all) const {
  const Jet closed(K, closing), wall_area(V, area), begin(iota, ln_sector), inner2 = exp(2.0 * begin),
                                                                            outer2 = inner2 + closed * wall_area;
  all.clear();
  all.push_back(begin);
  for (const double f : interfaces) {
    if (layered) {
      const Jet unloaded2 = Ro * Ro - wall_area, at = (1 - f) * sqrt(unloaded2) + f * Ro;
      all.push_back(0.5 * log(inner2 + closed * (at * at - unloaded2)));
    } else {
      all.push_back(log((1 - f) * exp(begin) + f * sqrt(outer2)));
    }
  }
  all.push_back(0.5 * log(outer2));
}

}  // namespace tunica::thick_wall
