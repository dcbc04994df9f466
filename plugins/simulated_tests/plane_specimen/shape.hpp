// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "../plane_elements/elements.hpp"

namespace tunica::plane {

/// The outline of a specimen between its grips, symmetric about both axes; its centre is the origin. Lengths in mm.
struct Shape {
  enum class Kind {
    strip,       ///< a rectangle
    dog_bone,    ///< narrow over `gauge_section`, then arcs of `fillet` up to the width at the grips
    with_a_hole  ///< a rectangle with a circular hole in its centre
  };
  Kind kind = Kind::strip;
  double length = 0, width = 0;                           ///< between the grips; at the grips
  double gauge_section = 0, gauge_width = 0, fillet = 0;  ///< of a dog-bone
  double hole = 0;                                        ///< radius
  [[nodiscard]] double half_width(double x) const;        ///< of a strip or a dog-bone at x
};

/// Nine-node quadrilaterals: corners, middles of the edges, centre, row by row in the local coordinates.
struct Mesh {
  std::vector<Vector> nodes;
  std::vector<std::array<std::size_t, 9>> elements;
  bool quarter = false;  ///< x ≥ 0, y ≥ 0 only; the axes are planes of symmetry
};

/// `along` and `across` count elements over the whole specimen: its length and width, or a quarter of the way around a
/// hole and the way from it to the edge. Refined where a dog-bone widens and at a hole.
Mesh mesh_of(const Shape& shape, std::size_t along, std::size_t across, bool quarter);

}  // namespace tunica::plane
