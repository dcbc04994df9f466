// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "cohort/likelihood.hpp"

namespace tunica::cohort {

/// What the residuals of a channel say near a point, in the coordinates ξ of a specimen: |r(ξ)|² ≈ |r + J (ξ − at)|².
struct ChannelSquares {
  Eigen::MatrixXd information;  ///< JᵀJ
  Eigen::VectorXd gradient;     ///< Jᵀr
  double squares = 0;           ///< |r|²
  std::size_t rows = 0;
};

/// The most likely ξ of a specimen under ξ ~ N(mean, F Fᵀ), and what its channels say there.
struct Mode {
  Status status;
  Eigen::VectorXd at;
  std::vector<ChannelSquares> channels;  ///< as SpecimenLikelihood::channels(), then one for priors
};

/// With ξ = mean + F u, u ~ N(0, 1), it minimises
///
///   Σ_c |r_c(ξ)|²/s_c² + |u|²
///
/// by Levenberg–Marquardt (Ceres' TinySolver), from the nearest u to `start`. F may be singular: what does not vary
/// between specimens then stays at its mean. `noise`: s_c by channel, priors have none.
Mode most_likely(SpecimenLikelihood& specimen, const Eigen::VectorXd& mean, const Eigen::MatrixXd& factor,
                 const std::vector<double>& noise, const Eigen::VectorXd& start);

}  // namespace tunica::cohort
