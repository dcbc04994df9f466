// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/QR>

#include "edges.hpp"
#include "equilibrium.hpp"

namespace tunica::field {

/// The displacements of measured edges, fitted to the field of one step together with what is inside: with the edge
/// coefficients b, the simulated displacements u(p, b) of the points and the measured ones û,
///
///     b(p) = argmin |u(p, b) − û|²,   G = ∂u/∂b,   du/dp = (1 − G G⁺) ∂u/∂p
///
/// the projection of Golub and Pereyra (SIAM J. Numer. Anal. 10:413, 1973) as Kaufman has it (BIT 15:49, 1975), which
/// leaves out terms of the size of the residual. So the noise of the edges enters the intervals of the parameters.
class EdgeFit {
 public:
  /// Displacements of the measured points, from displacements by dof.
  using Reading = std::function<Eigen::VectorXd(const std::vector<double>&)>;

  EdgeFit(const std::vector<Mode>& modes, Reading reading) : modes_(modes), reading_(std::move(reading)) {}

  /// Responses to each mode at a linearised equilibrium.
  void linearise(Equilibrium& body);
  /// The change of the coefficients that takes away what can be of `rest` = û − u.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& rest) const { return G_.solve(rest); }
  /// The same change, kept short: argmin |G c − rest|² + damping² g² |c|², g the longest column of G.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& rest, double damping) const;
  /// Adds the modes to prescribed displacements.
  void add(const Eigen::VectorXd& coefficients, std::vector<double>& prescribed) const;
  /// Adds the responses to the modes, after linearise().
  void add(const Eigen::VectorXd& coefficients, std::vector<double>& du, std::vector<double>& df) const;
  /// Lets the edges follow a change of displacements and forces by a parameter.
  void follow(std::vector<double>& du, std::vector<double>& df) const;

 private:
  const std::vector<Mode>& modes_;
  Reading reading_;
  std::vector<std::vector<double>> du_, df_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> G_;
};

}  // namespace tunica::field
