// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <ceres/jet.h>

#include "tube.hpp"

/// Geometry of the long tube (Chuong, Fung, J. Biomech. Eng. 108:189, 1986; docs/theory.md, the tube).
///
/// A stress-free sector with inner radius R_i, its outer one from R_o² − R_i² = K V, is closed (K = 2π/(2π − α)) to the
/// unloaded tube of measured outer radius, V = Ro² − Ri², stretched by λz and pressurised to r:
///
///   r² = ri² + (R² − R_i²)/(K λz),   λt = K r/R,   λr = 1/(λt λz).
///
/// With b = K/λz and a = K² ri² − b R_i² the squared circumferential stretch is c = b + a/R². Without residual stress
/// K = 1, and the sector is the unloaded tube.
namespace tunica::thick_wall {

/// Number of the geometric variables and their order: y = ln ri, λz, K, V and ι = ln R_i.
enum Variable : int { ln_inner, axial, closing, area, ln_sector, variable_count };
using Jet = ceres::Jet<double, variable_count>;

/// The wall of one prediction: what does not change along the rows.
struct Wall {
  double Ri, Ro, V;                               ///< unloaded; Ri with the thickness error in it
  double K = 1, iota = 0;                         ///< closing factor, ln R_i
  std::span<const double> interfaces;             ///< of the tube, which lives longer
  bool layered;                                   ///< interfaces in the unloaded wall, instead of in the sector
  double tether = 0;                              ///< kPa
  double inner = 1, outer = 1;                    ///< factors of W in the two layers of layer_ratio
  double inner_by_ratio = 0, outer_by_ratio = 0;  ///< their derivatives
  double closing_by_angle, area_by_error;         ///< dK/dα [1/deg], dV/dg [mm²]

  /// The sector is not closed yet: `iota` is that of a sector as thick as the wall. Ri ≤ 0 where the thickness error
  /// leaves no lumen, K ≤ 0 where the opening angle leaves no sector.
  Wall(const Tube& tube, std::span<const double> own);

  [[nodiscard]] std::size_t layer_count() const { return interfaces.size() + 1; }
  [[nodiscard]] double factor(std::size_t layer) const { return layered ? 1 : layer == 0 ? inner : outer; }
  /// ln R in the sector where layers begin and end, from inside; as many as layers and one.
  void edges(std::vector<Jet>& all) const;
};

/// Geometry of a section, in numbers or in jets over the variables.
template <class T>
struct Shape {
  T ri2, ro2, a, b, cz;
};

inline Shape<double> shape(const Wall& wall, double y, double lambda_z) {
  const double ri2 = std::exp(2 * y), b = wall.K / lambda_z;
  return {ri2, ri2 + wall.V / lambda_z, wall.K * wall.K * ri2 - b * std::exp(2 * wall.iota), b, lambda_z * lambda_z};
}
/// By hand: an expression of jets costs as much as the model at the points of a section.
inline Shape<Jet> shape_jet(const Wall& wall, double y, double lambda_z) {
  const Shape<double> at = shape(wall, y, lambda_z);
  const double K = wall.K, sector2 = std::exp(2 * wall.iota);
  Shape<Jet> jet{Jet(at.ri2), Jet(at.ro2), Jet(at.a), Jet(at.b), Jet(at.cz)};
  jet.ri2.v[ln_inner] = jet.ro2.v[ln_inner] = 2 * at.ri2;
  jet.ro2.v[axial] = -wall.V / (lambda_z * lambda_z);
  jet.ro2.v[area] = 1 / lambda_z;
  jet.b.v[axial] = -at.b / lambda_z;
  jet.b.v[closing] = 1 / lambda_z;
  jet.a.v[ln_inner] = 2 * K * K * at.ri2;
  jet.a.v[axial] = at.b * sector2 / lambda_z;
  jet.a.v[closing] = 2 * K * at.ri2 - sector2 / lambda_z;
  jet.a.v[ln_sector] = -2 * at.b * sector2;
  jet.cz.v[axial] = 2 * lambda_z;
  return jet;
}

}  // namespace tunica::thick_wall
