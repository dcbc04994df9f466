// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// Sets of residuals that would be seen if the base model were right: whitened noise with the uncertainty of its own
/// estimate, one column a draw, not yet projected.
struct Draws {
  Eigen::MatrixXf residuals;       ///< rows × draws
  Eigen::MatrixXf precision;       ///< variances × draws: (σ/σ̂)²; no rows where residuals say nothing of σ
  std::vector<std::size_t> group;  ///< by row: which variance; assembly::known_variance

  /// (σ/σ̂)² of every row; empty where residuals say nothing of σ.
  [[nodiscard]] Eigen::VectorXd precision_of_rows(Eigen::Index draw) const;
};

/// Where the residuals said how large the noise is, each draw says it anew: its rows of a group are divided by
/// √(Σ e²/Σ P_ii), with P the projector off the span of the estimate and e = P z; where d degrees of freedom came from
/// the other channels, z is first made larger by √(d/χ²_d), the channels of the draw are moderated anew (d_b degrees of
/// freedom about s_b), and the divisor is √((d_b s_b + Σ e²)/(d_b + Σ P_ii)). Where replicates said it, rows are
/// divided by √(χ²_ν/ν).
///
/// Such a draw also weighs its channels by its own σ̂. A channel whose noise is taken for too small has larger residuals
/// and more weight in every score; `precision` lets a detector see both.
Draws noise_draws(const Evidence& evidence, std::size_t draws, std::uint64_t seed);

}  // namespace tunica::diagnosis
