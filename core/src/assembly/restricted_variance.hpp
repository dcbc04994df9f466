// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace tunica::assembly {

/// Group of a row with known variance, which equals its shape.
constexpr std::size_t known_variance = static_cast<std::size_t>(-1);

/// The known facts about n rows with unknown variances: Var(row i) = s_g · shape_i with g = group_i, s_g to be
/// estimated.
struct VarianceProblem {
  Eigen::MatrixXd columns;         ///< n × k, of full rank: all that the rows may show besides noise
  Eigen::VectorXd residuals;       ///< n
  std::vector<std::size_t> group;  ///< n; 0, 1, …, or `known_variance`
  Eigen::VectorXd shape;           ///< n; variance up to the factor of the group
  std::vector<double> least;       ///< least s_g by group; empty: none
};

/// Restricted (residual) maximum likelihood of the s_g. With rows divided by their standard deviation, P the projector
/// off the columns and e = P r, the equation of every group is
///
///   Σ_{i∈g} e_i² = Σ_{i∈g} P_ii,        degrees of freedom of s_g = Σ_{i∈g} P_ii
///
/// (H. D. Patterson, R. Thompson, Biometrika 58:545, 1971), solved by scaling s_g with the ratio of the two sides.
struct RestrictedVariance {
  std::vector<double> variance;  ///< s_g; 1 where a group has no row
  std::vector<double> freedom;   ///< by group; 0 if the columns fit all of its rows
  std::vector<bool> at_least;    ///< groups that ended at their least value
  Eigen::VectorXd remainder;     ///< e, of rows with variance one
  Eigen::VectorXd leverage;      ///< 1 − P_ii
  double misfit = 0;             ///< −2 ln of the restricted likelihood, up to a constant of the columns
};
RestrictedVariance restricted_variance(const VarianceProblem& problem, std::size_t steps = 40);

/// The step of which all values are multiples, to within their own digits; 0 if no step is coarse enough to be seen. A
/// visible step makes at least one value in four occur twice. Rounding to a step q has the standard error q/√12.
double value_step(std::span<const double> values);

}  // namespace tunica::assembly
