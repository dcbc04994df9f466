// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "edge_fit.hpp"
#include "equilibrium.hpp"
#include "imperfections.hpp"
#include "meshed.hpp"

namespace tunica::field {

/// One step of a measured field: the equilibrium between the edges that fit its points best, and its derivatives. Not
/// shared between threads.
class StepSolver {
 public:
  /// Keeps `on`, `body` and `flaws` by reference; `step` counts from 0.
  StepSolver(const Meshed& on, std::size_t step, Equilibrium& body, const FlawedSheet* flaws = nullptr);

  /// Finite elements: the equilibrium itself with its derivatives, from the measured displacements, and where that
  /// fails along the way from the step before. Far from the parameters of the points, the edges may fit a share of the
  /// misfit worse than the best. Empty where it is found, else what went wrong.
  std::optional<std::string> settle(bool by_parameters);
  /// Near that from where the body is, along the way: an equilibrium of nearly the best edges. Moves the body only.
  std::optional<std::string> along_the_way();
  /// The modified Newton method from the smoothed measured displacements ũ, up to steps of 1e-5 of them,
  ///
  ///     u ← u − K⁻¹ f(u) + Σ b_k ∂u/∂b_k,   K = ∂f/∂u of an earlier u,   b from the points,
  ///
  /// with derivatives by that K. Where ũ is far from equilibrium, one linear step from it.
  std::optional<std::string> nearly_settle(bool by_parameters);
  [[nodiscard]] const std::vector<double>& displacements() const { return u_; }  ///< by dof, mm
  [[nodiscard]] const std::vector<double>& forces() const { return f_; }         ///< by dof, per thickness, kPa·mm
  void by_parameter(std::size_t j, std::vector<double>& du, std::vector<double>& df) const;
  /// The same by flaw q; false where it changes nothing.
  bool by_flaw(std::size_t q, std::vector<double>& du, std::vector<double>& df) const;

 private:
  struct Change {
    std::vector<double> u, f;  ///< by dof
  };
  [[nodiscard]] Change next() const;
  [[nodiscard]] std::vector<double> with_flaws(std::vector<double> u) const;
  bool begin_as_measured();
  bool converge(bool by_parameters);
  bool chase(Change change);
  [[nodiscard]] const FieldRows::Step& step() const { return on_.rows().steps()[step_]; }
  [[nodiscard]] Eigen::VectorXd rest(const std::vector<double>& u) const;

  const Meshed& on_;
  std::size_t step_;
  Equilibrium& body_;
  const FlawedSheet* flaws_;
  EdgeFit edges_;
  Eigen::VectorXd measured_;
  std::vector<double> u_, f_;
};

}  // namespace tunica::field
