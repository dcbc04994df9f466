// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "specimen.hpp"

namespace tunica::field {

/// The known values of one displacement component on one side.
enum class Edge {
  free,     ///< no traction
  fixed,    ///< 0
  uniform,  ///< measured, the same all along: a rigid grip that does not turn
  measured  ///< measured, smooth along the side
};

/// Conditions by side and component.
using Edges = std::array<std::array<Edge, 2>, 4>;

/// Points of one step with their displacements, mm.
struct Frame {
  std::vector<Vector> points;
  std::array<std::vector<double>, 2> displacements;  ///< by component, NaN where not measured
};

/// Where the edges of one step begin, before EdgeFit has moved them: displacements by dof, 0 where none is prescribed.
///
/// On a measured side they begin at what follows from the points within four spacings of it, by least squares on
///
///     u(s, d) = Σ_{k ≤ degree} (a_k + b_k d) P_k(s) + d² Σ_{k ≤ 2} c_k P_k(s) + e d³
///
/// with Legendre polynomials P_k of the place s along the side, −1 to 1, and the distance d from it. Throws InputError
/// where too few points are near, or none over more than four spacings of a measured side, its ends included.
std::vector<double> beginning(const Specimen& specimen, const Edges& edges, const Frame& frame, std::size_t degree);

/// P_k along every uniform or measured side, of each component. A corner of two such sides moves with the later one,
/// one with a fixed side not at all.
std::vector<Mode> modes(const Specimen& specimen, const Edges& edges, std::size_t degree);

/// The nodes of a uniform or measured side that its modes of a component move.
std::vector<std::size_t> moved_nodes(const Specimen& specimen, const Edges& edges, std::size_t side, std::size_t c);

}  // namespace tunica::field
