// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "row.hpp"

namespace tunica::fe {

/// Tissue around the tube: springs of the pressure p = κ (r − ρ) at each point of the outer face, where ρ is r without
/// pressure at the same axial stretch. They store
///
///   Π = ∫ h(r) dz,   h = κ ∫_ρ^r (s − ρ) s ds,
///
/// over 2π, with z in the loaded state: a potential, so that the tangent stays symmetric. In a section that does not
/// vary along the axis it is the support of the long tube.
struct Support {
  double slope = 0;          ///< κ, kPa/mm
  std::vector<double> free;  ///< ρ at the outer nodes, by plane; empty = no support
  static double pressed(double r, double rho) { return (r - rho) * r; }  ///< h'(r)/κ
  static double stored(double r, double rho) {                           ///< h/κ
    const double d = r - rho;
    return d * d * (d / 3 + rho / 2);
  }
  static double by_free(double r, double rho) { return -(r - rho) * (r + rho) / 2; }  ///< ∂(h/κ)/∂ρ
};

/// A Gauss point of the outer edge of a row of elements.
template <std::size_t Order>
struct EdgePoint {
  static constexpr std::size_t side = Element<Order>::side;
  double r = 0, z = 0, rho = 0;  ///< z: its derivative along the edge
  std::array<std::size_t, side> dof{}, plane{};

  EdgePoint(const Mesh& mesh, const Element<Order>& element, const Support& support, const State& state,
            std::size_t row, std::size_t g) {
    for (std::size_t k = 0; k < side; ++k) {
      plane[k] = row * Order + k;
      dof[k] = 2 * mesh.node(mesh.across() - 1, plane[k]);
      r += element.shape_1d[g][k] * state.x[dof[k]];
      z += element.slope_1d[g][k] * state.x[dof[k] + 1];
      rho += element.shape_1d[g][k] * support.free[plane[k]];
    }
  }
};

/// Adds ∂Π/∂x of the support to `force` and, unless `matrix` is null, ∂²Π/∂x² to it: Matrix::add(i, j, value) counts
/// for (j, i) too.
template <std::size_t Order, class Matrix>
void add_support(const Mesh& mesh, const Element<Order>& element, const Support& support, const State& state,
                 std::vector<double>& force, Matrix* matrix) {
  for (std::size_t row = 0; row < mesh.axial; ++row)
    for (std::size_t g = 0; g < Element<Order>::points_1d; ++g) {
      const EdgePoint<Order> at(mesh, element, support, state, row, g);
      const auto& N = element.shape_1d[g];
      const auto& D = element.slope_1d[g];
      const double w = element.weight_1d[g] * support.slope, pressed = Support::pressed(at.r, at.rho);
      for (std::size_t k = 0; k < at.side; ++k) {
        force[at.dof[k]] += w * at.z * pressed * N[k];
        force[at.dof[k] + 1] += w * Support::stored(at.r, at.rho) * D[k];
      }
      for (std::size_t k = 0; k < (matrix == nullptr ? 0 : at.side); ++k)
        for (std::size_t l = 0; l < at.side; ++l) {
          if (k <= l) matrix->add(at.dof[k], at.dof[l], w * at.z * (2 * at.r - at.rho) * N[k] * N[l]);
          matrix->add(at.dof[k], at.dof[l] + 1, w * pressed * N[k] * D[l]);
        }
    }
}

/// −right · ∂(∂Π/∂x)/∂κ, and by the free radius of each plane.
template <std::size_t Order>
double contract_support(const Mesh& mesh, const Element<Order>& element, const Support& support, const State& state,
                        std::span<const double> right, std::span<double> by_free);

}  // namespace tunica::fe
