// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "population/population.hpp"

namespace tunica::population {

/// ξ of a new specimen of a new animal: mean X β, covariance Ω + Ω_a + X cov(β) Xᵀ.
struct Predictive {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  double freedom = 1;               ///< of the mean of the reference
  Eigen::MatrixXd mean_covariance;  ///< X cov(β) Xᵀ alone: of the mean material
};

/// `levels`: of each factor of the cohort; those outside the design count for nothing.
Predictive predictive(const Population& population, const std::vector<std::size_t>& levels);

/// Draws of ξ, one a column, from Student's t with `freedom`, scaled so that the marginal of exact values is exact:
/// mean + covariance^½ z √(freedom/χ²). Ω is estimated from few specimens, so that normal draws would be too narrow.
/// Draw k depends on seed and k alone.
Eigen::MatrixXd draws(const Predictive& predictive, std::uint64_t seed, std::size_t count);

}  // namespace tunica::population
