// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace tunica::fe {

enum class Ends {
  clamped,                ///< radially fixed from the start
  clamped_after_stretch,  ///< radially free while the tube is stretched, then held
  sliding                 ///< radially free
};

/// The wall over half the length: Ri ≤ R ≤ Ro, 0 ≤ Z ≤ length/2, Z = 0 the plane of symmetry, Z = length/2 the end.
/// Rectangular elements, equal along R; node (i, k) of the structured grid has number k · across + i, so that
/// neighbours along the short direction follow each other and the matrix is a narrow band.
struct Mesh {
  std::size_t order = 1;                ///< 1 = four-node, 2 = nine-node elements
  std::size_t radial = 25, axial = 50;  ///< elements
  double inner = 0, outer = 0;          ///< mm
  std::vector<double> layer;            ///< Z of the planes of nodes
  Ends ends = Ends::clamped;

  /// `grading` g ≥ 1: element k ends at Z = (L/2) s(k/n), where s(t) = 1 − (1 − t)^g: the last elements are smallest.
  Mesh(std::size_t order, std::size_t radial, std::size_t axial, double inner, double outer, double half_length,
       double grading, Ends ends);

  [[nodiscard]] std::size_t across() const { return order * radial + 1; }  ///< nodes along R
  [[nodiscard]] std::size_t planes() const { return order * axial + 1; }   ///< planes of nodes along Z
  [[nodiscard]] std::size_t nodes() const { return across() * planes(); }
  [[nodiscard]] std::size_t node(std::size_t i, std::size_t k) const { return k * across() + i; }
  [[nodiscard]] double radius(std::size_t i) const {
    return inner + (outer - inner) * static_cast<double>(i) / static_cast<double>(across() - 1);
  }
  [[nodiscard]] double half_length() const { return layer.back(); }
};

}  // namespace tunica::fe
