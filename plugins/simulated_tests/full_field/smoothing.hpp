// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "specimen.hpp"

namespace tunica::field {

/// A measured displacement on the nodes of a mesh: the smoothest that agrees with the points,
///
///     min_u  Σ_points (N u − û)² + ρ (ℓ/2π)⁴ ∫ |∇∇u|² dA
///
/// with ρ points a unit of area. Waves shorter than ℓ are smoothed away, and where no point lies the displacement is
/// as straight as can be. ∇∇u is a difference of gradients, inside of triangles and between neighbours. Immutable.
class Smoothing {
 public:
  explicit Smoothing(const Specimen& specimen);

  /// The wavelength, mm, that predicts one point in five best from the others; `values` one a place.
  [[nodiscard]] double wavelength(const std::vector<Place>& places, const Eigen::VectorXd& values) const;
  /// The values at the nodes; `values` has a row a place and a column a quantity.
  [[nodiscard]] Eigen::MatrixXd at_nodes(const std::vector<Place>& places, const Eigen::MatrixXd& values,
                                         double wavelength) const;

 private:
  double area_;
  Eigen::SparseMatrix<double> bending_;  ///< uᵀ B u = ∫ |∇∇u|² dA
};

}  // namespace tunica::field
