// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "../thick_wall_pressurisation/wall.hpp"
#include "mesh.hpp"

namespace tunica::fe {

/// What the geometry of a wall depends on beside its loads: relative thickness (outer radius fixed), K and ι = ln R_i
/// of the sector, ratio of the two layers of one model. See the long tube, wall.hpp.
enum Geometry : std::size_t { by_thickness, by_closing, by_sector, by_ratio, geometry_count };

/// How the stress-free sector was closed to the unloaded tube, at the Gauss points of a row of elements: a point of
/// the sector at R_s² = R_i² + K (R² − Ri²) went to R, so that
///
///   F₀ = diag(λ₀, 1, 1/λ₀) in t, z, r,   λ₀ = K R/R_s,
///
/// and by which factor the two layers of layer_ratio scale the energy there. In a column of elements that the interface
/// cuts, the factor is linear along R with the same integral and the same first moment, as far as it stays positive:
/// circumferential and axial strain are continuous there.
struct Closing {
  bool opened = false, factored = false;  ///< otherwise the vectors below hold derivatives alone
  std::vector<double> square;             ///< λ₀² at the points, lanes last
  std::vector<double> factor;             ///< of W at the points
  std::array<std::vector<double>, geometry_count> log_square_by, log_factor_by;  ///< of their logarithms

  /// `derivatives`: whether the last line is wanted. `interface` is that of layer_ratio.
  Closing(const Mesh& mesh, const thick_wall::Wall& wall, double ratio, bool derivatives);
  [[nodiscard]] bool none() const { return !opened && !factored; }
  [[nodiscard]] bool differentiated() const { return !log_square_by[0].empty(); }
};

}  // namespace tunica::fe
