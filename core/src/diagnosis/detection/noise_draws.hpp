// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/evidence/curves.hpp"

namespace tunica::diagnosis {

/// Sets of residuals that would be seen if the base model were right: whitened noise with the uncertainty of its own
/// estimate, one column a draw, not yet projected.
Eigen::MatrixXf noise_draws(const std::vector<Curve>& curves, Eigen::Index rows, std::size_t draws, std::uint64_t seed);

}  // namespace tunica::diagnosis
