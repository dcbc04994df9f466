// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "sections.hpp"

namespace tunica::thick_wall {

/// A state of equilibrium, and the tangent to go on with. With tethering k the pressure is that of the wall and of the
/// support, p + k (D/D0 − its value `support_free` at p = 0).
struct Equilibrium {
  double axial_stretch = 1, y = 0, p = 0;
  double p_y = 0, p_axial = 0;
  double before_p = 0, before_u = 0;  ///< p and 1/p_y of the state before, at the same axial stretch
  bool has_before = false;
  bool supported = false;  ///< p and p_y have the support in them
  bool settled = true;     ///< y belongs to p to 1e-6, or nothing better was found
};

/// Follows the tube from rest: straight segments in the plane of axial stretch and pressure, Newton's method with the
/// tangent (and the bend of the last two states) as predictor. A segment is cut where a step is too large, overflows,
/// leaves the rising branch or does not contract, so that what is found is the state that loading leads to, and a limit
/// pressure is noticed as one. States are good to 1e-3 of a step in y or better: starts for Newton's method.
class Path {
 public:
  Path(Sections& sections, const Wall& wall) : sections_(sections), wall_(wall) {}

  /// The unloaded tube.
  Status begin(Equilibrium& at);
  /// From `at` to the given axial stretch and pressure. With `support_free` (the outer radius there at p = 0; at one
  /// axial stretch only) the support acts. Failure: why, and the pressure reached, in words; `at` is then the last
  /// state.
  Status follow(Equilibrium& at, double axial_stretch, double p, double support_free = 0);

 private:
  enum class Trouble { none, overflow, falling, not_contracting };
  Trouble evaluate(Equilibrium& trial, double support_free, double& correction);
  Trouble correct(Equilibrium& trial, double support_free, double step);
  void settle(Equilibrium& at, double support_free);
  [[nodiscard]] std::string words(const Equilibrium& at, Trouble trouble, double p) const;

  Sections& sections_;
  const Wall& wall_;
};

/// Whether the pressure rises all over a step of y by dp, with these slopes at its ends. Where a cubic through all
/// could fall it says no.
inline bool rises(double dp, double dy, double p_y_before, double p_y_after) {
  const double mean = dp / dy, u = p_y_before / mean, v = p_y_after / mean;
  return mean > 0 && u * u + v * v <= 16;
}

/// Outer radius at y.
inline double outer_radius(const Wall& wall, double y, double axial_stretch) {
  return std::sqrt(std::exp(2 * y) + wall.V / axial_stretch);
}

/// Pressure of the support from outside, k (ro − its value at p = 0)/Ro, and its slope by y.
inline double support(const Wall& wall, double y, double axial_stretch, double support_free) {
  return wall.tether * (outer_radius(wall, y, axial_stretch) - support_free) / wall.Ro;
}
inline double support_slope(const Wall& wall, double y, double axial_stretch) {
  return wall.tether * std::exp(2 * y) / (outer_radius(wall, y, axial_stretch) * wall.Ro);
}

}  // namespace tunica::thick_wall
