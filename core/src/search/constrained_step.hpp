// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Core>

namespace tunica::search {

/// min ‖r + J s‖² subject to c + A s ≤ 0, for a handful of unknowns and any number of inequalities.
struct ConstrainedStep {
  Eigen::VectorXd step;
  double largest_multiplier = 0;  ///< of ‖·‖² by c
};

/// None if the inequalities contradict each other. A ridge of 1e-3 keeps the step short in the null space of J.
///
/// It is solved as a least-distance problem by non-negative least squares. Source: C. L. Lawson, R. J. Hanson, Solving
/// Least Squares Problems (1974), chapter 23, algorithms NNLS and LDP.
std::optional<ConstrainedStep> constrained_step(const Eigen::MatrixXd& J, const Eigen::VectorXd& r,
                                                const Eigen::MatrixXd& A, const Eigen::VectorXd& c);

}  // namespace tunica::search
