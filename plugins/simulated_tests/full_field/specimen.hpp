// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/SparseCore>

#include "../plane_elements/elements.hpp"
#include "mesh.hpp"

namespace tunica::field {

/// The sides of the box around a specimen; a side has the nodes of the mesh that lie on it.
enum class Side : std::size_t { left, right, bottom, top };
constexpr std::array<const char*, 4> side_names{"left", "right", "bottom", "top"};
/// The axis that a side is normal to, and whether the outside is towards its positive end.
constexpr std::size_t axis_of(std::size_t side) { return side / 2; }
constexpr double outwards(std::size_t side) { return side % 2 == 0 ? -1 : 1; }

/// Where a point lies: the nodes of its triangle with their weights.
struct Place {
  std::array<std::size_t, 6> nodes{};
  std::array<double, 6> weights{};
};

/// A way in which an edge moves: dofs with their displacements.
using Mode = std::vector<std::pair<std::size_t, double>>;

/// A meshed sheet of unit thickness with its boundary. The displacement of node a: u_x at 2a, u_y at 2a + 1, mm.
/// Immutable, shared by all threads.
class Specimen {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// `held`: whether a component is prescribed on a side.
  Specimen(Mesh mesh, const std::array<std::array<bool, 2>, 4>& held);

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] const plane::Elements<6, 3>& elements() const { return elements_; }
  [[nodiscard]] const std::vector<Vector>& gauss_places() const { return gauss_places_; }  ///< unloaded, mm
  [[nodiscard]] std::size_t dofs() const { return 2 * mesh_.nodes.size(); }
  [[nodiscard]] const std::vector<std::size_t>& free() const { return free_; }  ///< dofs, by unknown
  [[nodiscard]] bool held(std::size_t dof) const { return unknown_[dof] == none; }
  [[nodiscard]] const std::vector<std::size_t>& nodes_on(std::size_t side) const { return sides_[side]; }
  [[nodiscard]] double area() const;
  /// From a side to the nearest of these points, along its normal.
  [[nodiscard]] double gap(std::size_t side, const std::vector<Vector>& points) const;
  [[nodiscard]] double extent(std::size_t axis) const { return high_[axis] - low_[axis]; }
  [[nodiscard]] double middle(std::size_t axis) const { return (low_[axis] + high_[axis]) / 2; }  ///< of the box
  /// A matrix with the pattern of the stiffness over the unknowns, lower triangle.
  [[nodiscard]] const Eigen::SparseMatrix<double>& pattern() const { return pattern_; }
  /// Empty where the point lies farther outside than a twentieth of a triangle.
  [[nodiscard]] std::optional<Place> find(Vector point) const;

 private:
  void make_elements();
  Mesh mesh_;
  plane::Elements<6, 3> elements_;
  std::vector<Vector> gauss_places_;
  Vector low_{}, high_{};
  std::vector<std::array<double, 4>> boxes_;  ///< of each triangle with a margin: x from, to, y from, to
  std::array<std::vector<std::size_t>, 4> sides_;
  std::vector<std::size_t> free_, unknown_;
  Eigen::SparseMatrix<double> pattern_;
};

}  // namespace tunica::field
