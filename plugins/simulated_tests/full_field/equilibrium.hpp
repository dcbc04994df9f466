// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/SparseCholesky>

#include "../plane_elements/membrane.hpp"
#include "specimen.hpp"

namespace tunica::field {

/// One specimen, its edge displacements prescribed step by step: finds the free displacements with f(u) = 0 there, by
/// Newton's method. Not shared between threads.
class Equilibrium {
 public:
  /// `weights`: thickness or stiffness at each Gauss point over that of the specimen; empty = 1.
  Equilibrium(const Specimen& specimen, const Model& model, std::span<const double> parameters,
              std::array<double, 2> along, plane::Faces faces, std::vector<double> weights = {});

  /// Moves to the next step: `prescribed` by dof, read where held. The way is halved where Newton's method fails. Empty
  /// where it arrived, else what went wrong.
  std::optional<std::string> move_to(const std::vector<double>& prescribed);
  struct State {
    std::vector<double> u, normal;  ///< displacements by dof; C_rr of every Gauss point, 1 where empty
  };
  [[nodiscard]] State state() const { return {u_, membrane_.normal}; }
  /// Begins at these displacements, in equilibrium or not.
  void begin(State state);
  /// Moves by a change of all displacements; false where the material has no answer there.
  bool move_by(const std::vector<double>& change);
  /// Forces where it is; false where the material has no answer there.
  bool stay() { return evaluate(false, false); }
  /// Prepares derivatives by parameters where it is, with the stiffness of the last linearise().
  bool stay_with_parameters() { return evaluate(false, true); }
  /// To where linearise() was called, for its derivatives.
  void return_to_linearised();
  /// −K⁻¹ f by dof, 0 where held, with the stiffness of the last linearise() and the forces of where it is.
  [[nodiscard]] std::vector<double> newton_step() const;
  /// Adds the change of forces with one of displacements, both by dof, after linearise().
  void add_force_change(const std::vector<double>& du, std::vector<double>& df) const;
  /// Prepares derivatives at the solution, also by the model's parameters. False where the stiffness has no factor.
  bool linearise(bool by_parameters);

  [[nodiscard]] const std::vector<double>& displacements() const { return u_; }
  [[nodiscard]] const std::vector<double>& forces() const { return f_; }  ///< by dof, per thickness, kPa·mm
  [[nodiscard]] const plane::Membrane& membrane() const { return membrane_; }
  [[nodiscard]] const std::vector<plane::Gradient>& gradients() const { return F_; }
  /// After linearise(): derivatives of displacements and forces by parameter j, by dof.
  void by_parameter(std::size_t j, std::vector<double>& du, std::vector<double>& df) const;
  /// The same by a weight that changes so at every Gauss point.
  void by_weight(std::span<const double> change, std::vector<double>& du, std::vector<double>& df) const;
  /// The same by an edge that moves in this way.
  void by_edge(const Mode& mode, std::vector<double>& du, std::vector<double>& df) const;

 private:
  using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower>;
  static constexpr int most_iterations = 25;
  static constexpr double smallest_step = 2e-3;  ///< of the way from step to step
  static constexpr double small_step = 0.01;     ///< of the displacements, by which one factor serves the next step
  bool evaluate(bool with_tangent, bool with_parameters);
  bool factor(const std::vector<double>& direction);
  bool newton(std::vector<double> direction);
  bool search_along(const Eigen::VectorXd& du);
  void weigh(std::vector<double>& of_points) const;
  void by_stress(std::span<const double> change, std::vector<double>& du, std::vector<double>& df) const;
  [[nodiscard]] Eigen::VectorXd solve(const std::vector<double>& of_dofs) const;
  void add_free(const Eigen::VectorXd& change, std::vector<double>& u) const;

  const Specimen& specimen_;
  plane::Membrane membrane_;  ///< its stress and derivatives with the weights
  std::vector<double> weights_;
  std::vector<double> u_, f_, by_direction_;
  std::vector<plane::Gradient> F_, linearised_F_;
  std::vector<double> linearised_stress_;
  Eigen::SparseMatrix<double> K_;
  Factor factor_;
  bool analysed_ = false;
};

}  // namespace tunica::field
