// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// Of a symmetric matrix: adds to (i, j) and thereby to (j, i).
struct Entry {
  std::size_t i, j;
  double value;
};

/// Adds ∂Π/∂x of the support to `force`.
template <std::size_t Order>
void add_support(const Mesh& mesh, const Element<Order>& element, const Support& support, const State& state,
                 std::vector<double>& force);

/// Appends ∂²Π/∂x² of the support.
template <std::size_t Order>
void stiffen_by_support(const Mesh& mesh, const Element<Order>& element, const Support& support, const State& state,
                        std::vector<Entry>& matrix);

/// −right · ∂(∂Π/∂x)/∂κ, and by the free radius of each plane.
template <std::size_t Order>
double contract_support(const Mesh& mesh, const Element<Order>& element, const Support& support, const State& state,
                        std::span<const double> right, std::span<double> by_free);

}  // namespace tunica::fe
