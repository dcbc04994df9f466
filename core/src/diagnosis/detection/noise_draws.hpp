// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// Sets of residuals that would be seen if the base model were right: whitened noise with the uncertainty of its own
/// estimate, one column a draw, not yet projected.
///
/// Where the residuals said how large the noise is, each draw says it anew: its rows of a group are divided by
/// √(Σ e²/Σ P_ii), with P the projector off the span of the estimate and e = P z; where d degrees of freedom came from
/// the other channels, z is first made larger by √(d/χ²_d), and the divisor is √((d + Σ e²)/(d + Σ P_ii)). Where
/// replicates said it, rows are divided by √(χ²_ν/ν).
Eigen::MatrixXf noise_draws(const Evidence& evidence, std::size_t draws, std::uint64_t seed);

}  // namespace tunica::diagnosis
