// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "assembly/restricted_variance.hpp"

namespace tunica::assembly {

/// Noise that grows with the level of the rows: σ² ∝ 1 + share · (level/largest level of the group)².
struct GrowingNoise {
  std::vector<double> share;        ///< by family of groups; 0 where next to nothing speaks for one
  std::vector<double> probability;  ///< of what else it may be; empty where no level tells anything
  Eigen::MatrixXd variance;         ///< of a row (rows) if so (columns), over that by `share`; mean of a group one
};

/// First one share for all groups, the mean over what is likely: few rows seldom tell a share of 3 from none, and
/// either would be taken for certain. Then another one for a family of groups, where that lowers the misfit by more
/// than `price`. `problem.shape` is multiplied accordingly.
GrowingNoise growing_noise(VarianceProblem& problem, const std::vector<std::size_t>& family_of_group,
                           const Eigen::VectorXd& level, double price = 4);

}  // namespace tunica::assembly
