// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// Simulated residuals under a correct base model: whitened noise with the uncertainty of its own estimate. Each column
/// is a draw, not yet projected.
struct Draws {
  Eigen::MatrixXf residuals;       ///< rows × draws
  Eigen::MatrixXf precision;       ///< variances × draws: (σ/σ̂)²; no rows where residuals say nothing of σ
  std::vector<std::size_t> group;  ///< by row: which variance; assembly::known_variance

  /// (σ/σ̂)² of every row; empty where residuals say nothing of σ.
  [[nodiscard]] Eigen::VectorXd precision_of_rows(Eigen::Index draw) const;
};

/// If the noise was estimated from residuals, each draw estimates it anew. The rows of a group are divided by √(Σ e²/Σ
/// P_ii), with P the projector off the span of the estimate and e = P z. If d degrees of freedom came from the other
/// channels, z is first multiplied by √(d/χ²_d). The channels of the draw are then moderated anew (d_b degrees of
/// freedom about s_b), and the divisor is √((d_b s_b + Σ e²)/(d_b + Σ P_ii)). If the noise came from replicates, rows
/// are divided by √(χ²_ν/ν).
///
/// Such a draw also weights its channels by its own σ̂. A channel with underestimated noise has larger residuals and
/// more weight in every score; `precision` makes both visible to a detector.
Draws noise_draws(const Evidence& evidence, std::size_t draws, std::uint64_t seed);

}  // namespace tunica::diagnosis
