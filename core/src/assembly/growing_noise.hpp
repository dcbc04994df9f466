// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "assembly/restricted_variance.hpp"

namespace tunica::assembly {

/// Noise that grows with the level of the rows: σ² ∝ 1 + share · (level/largest level of the group)².
struct GrowingNoise {
  std::vector<double> share;        ///< by family of groups; 0 if almost nothing indicates one
  std::vector<double> probability;  ///< of the alternatives; empty if levels are uninformative
  Eigen::MatrixXd variance;         ///< of a row (rows) if so (columns), over that by `share`; mean of a group one
};

/// First it estimates one share for all groups, as the mean over the likely shares. Few rows rarely distinguish a share
/// of 3 from none, and a single best value would feign certainty. Then a family of groups gets its own share if that
/// lowers the misfit by more than `price`. `problem.shape` is multiplied accordingly.
GrowingNoise growing_noise(VarianceProblem& problem, const std::vector<std::size_t>& family_of_group,
                           const Eigen::VectorXd& level, double price = 4);

}  // namespace tunica::assembly
