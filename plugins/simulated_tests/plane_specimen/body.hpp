// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "../plane_elements/elements.hpp"
#include "shape.hpp"

namespace tunica::plane {

/// Dofs with their weights: the reading of a marker or a gauge from the displacements.
using Reading = std::vector<std::pair<std::size_t, double>>;

/// How the ends are held.
enum class Ends { clamped, sliding };

/// A mesh with its boundary: which displacements are free, how those of the grips follow the pull, and the pattern of
/// the stiffness. Displacement of node a: u_x at 2a, u_y at 2a + 1, mm. Immutable, shared by all threads.
class Body {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  Body(const Shape& shape, const Mesh& mesh, Ends ends);

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] std::size_t points() const { return 9 * mesh_.elements.size(); }  ///< Gauss points
  [[nodiscard]] std::size_t dofs() const { return 2 * mesh_.nodes.size(); }
  [[nodiscard]] std::size_t unknowns() const { return free_.size(); }
  /// u = 0 where held, and pull times this at the grips.
  [[nodiscard]] const std::vector<double>& grips() const { return grips_; }
  [[nodiscard]] const std::vector<std::size_t>& free() const { return free_; }  ///< dofs, by unknown
  /// The unknown that a dof is; none where it is prescribed.
  [[nodiscard]] std::size_t unknown(std::size_t dof) const { return unknown_[dof]; }
  /// Of the point (x, y) of the unloaded specimen: a component of its displacement. Empty where it is outside.
  [[nodiscard]] Reading displacement(Vector point, std::size_t component) const;

  /// F, and C̄ for the membrane, at every Gauss point.
  void strain(std::span<const double> u, std::vector<Gradient>& F, Membrane& membrane) const {
    elements_.strain(u, F, membrane);
  }
  /// Nodal forces of the membrane's stress, or of one of its derivatives by parameters: 3n entries.
  void forces(const std::vector<Gradient>& F, std::span<const double> stress, std::vector<double>& f) const {
    f.assign(dofs(), 0);
    elements_.add_forces(F, stress, f);
  }
  /// The stiffness over the free displacements, and its columns times the grips: ∂f/∂pull.
  void stiffness(const std::vector<Gradient>& F, const Membrane& membrane, Eigen::SparseMatrix<double>& K,
                 std::vector<double>& by_pull) const {
    elements_.stiffness(F, membrane, grips_, K, by_pull);
  }
  /// A matrix with the pattern of stiffness().
  [[nodiscard]] const Eigen::SparseMatrix<double>& pattern() const { return pattern_; }

 private:
  void hold(const Shape& shape, Ends ends);

  Mesh mesh_;
  Elements<9, 9> elements_;
  std::vector<double> grips_;         ///< by dof
  std::vector<std::size_t> free_;     ///< dofs that are unknown
  std::vector<std::size_t> unknown_;  ///< by dof; none where it is prescribed
  Eigen::SparseMatrix<double> pattern_;
};

}  // namespace tunica::plane
