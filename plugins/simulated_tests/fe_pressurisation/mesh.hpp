// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tunica::fe {

enum class Ends {
  clamped,                ///< radially fixed from the start
  clamped_after_stretch,  ///< radially free while the tube is stretched, then held
  sliding                 ///< radially free
};

/// The wall over half the length: Ri ≤ R ≤ Ro, 0 ≤ Z ≤ length/2, Z = 0 the plane of symmetry, Z = length/2 the end.
/// Rectangular elements, equal along R within each layer of the wall; node (i, k) of the structured grid has number k ·
/// across + i, so that neighbours along the short direction follow each other and the matrix is a narrow band.
struct Mesh {
  std::size_t order = 1;                ///< 1 = four-node, 2 = nine-node elements
  std::size_t radial = 25, axial = 50;  ///< elements
  double inner = 0, outer = 0;          ///< mm
  std::vector<double> layer;            ///< Z of the planes of nodes
  Ends ends = Ends::clamped;
  std::vector<std::size_t> columns;  ///< elements across each layer of the wall, from inside

  /// `grading` g ≥ 1: element k ends at Z = (L/2) s(k/n), where s(t) = 1 − (1 − t)^g: the last elements are smallest.
  /// Lines of the mesh lie on the `interfaces` between layers, which are fractions of the thickness, ascending.
  Mesh(std::size_t order, std::size_t radial, std::size_t axial, double inner, double outer, double half_length,
       double grading, Ends ends, std::span<const double> interfaces = {});

  [[nodiscard]] std::size_t across() const { return order * radial + 1; }  ///< nodes along R
  [[nodiscard]] std::size_t planes() const { return order * axial + 1; }   ///< planes of nodes along Z
  [[nodiscard]] std::size_t nodes() const { return across() * planes(); }
  [[nodiscard]] std::size_t node(std::size_t i, std::size_t k) const { return k * across() + i; }
  [[nodiscard]] double radius(std::size_t i) const {
    if (line_.empty()) return inner + (outer - inner) * static_cast<double>(i) / static_cast<double>(across() - 1);
    const std::size_t e = i / order, part = i % order;
    if (part == 0) return edge(e);
    return edge(e) + (edge(e + 1) - edge(e)) * static_cast<double>(part) / static_cast<double>(order);
  }
  /// R where element e begins, and where e − 1 ends.
  [[nodiscard]] double edge(std::size_t e) const {
    return inner + (outer - inner) * (line_.empty() ? static_cast<double>(e) / static_cast<double>(radial) : line_[e]);
  }
  /// Whether all elements are equally long along R.
  [[nodiscard]] bool uniform() const { return line_.empty(); }
  [[nodiscard]] double half_length() const { return layer.back(); }

 private:
  std::vector<double> line_;  ///< fractions of the thickness where elements begin; empty = uniform
};

/// How many of `radial` elements each layer gets: one, and the rest in proportion to its share of the thickness.
std::vector<std::size_t> columns_of(std::size_t radial, std::span<const double> interfaces);

}  // namespace tunica::fe
