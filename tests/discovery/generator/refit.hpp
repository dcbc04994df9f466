// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <Eigen/Dense>

#include "world.hpp"

namespace blind {

/// Noise of every observation: its standard deviation, and the correlation with the one before it in the same channel.
struct Noise {
  Eigen::VectorXd sd;
  double correlation = 0;
};

/// e → L⁻¹ e, L Lᵀ the covariance: e_k/σ_k less ρ e_{k−1}/σ_{k−1}, over √(1 − ρ²), the first of a channel as it is.
Eigen::VectorXd whiten(const Protocol& protocol, const Noise& noise, std::span<const double> error);

/// The base model refitted: its parameters (bases.hpp) within the bounds of the experiment file, moduli as logarithms.
struct Refit {
  Tissue tissue;
  double misfit = 0;         ///< whitened sum of squares, Λ when the data have no noise
  Eigen::VectorXd residual;  ///< whitened, data less prediction
  Eigen::MatrixXd jacobian;  ///< whitened, of the prediction, at the end
  bool converged = false;
};
Refit refit(const Protocol& protocol, const Noise& noise, std::span<const double> data, const Tissue& start);

}  // namespace blind
