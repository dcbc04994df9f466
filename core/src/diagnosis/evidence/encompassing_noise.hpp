// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// Whether the noise of some channel has to be estimated from residuals.
bool has_open_noise(const Evidence& evidence);

/// Noise of the open channels (`NoiseSource::open`) by restricted likelihood (assembly/restricted_variance.hpp): from
/// the residuals of a fit outside the span of
///
///   the fit's Jacobian, smooth shapes of every curve (smooth_columns.hpp), and `signatures`, in whitened rows of the
///   evidence: those of which the span so far leaves most come first, until it leaves less than a quarter of each,
///   sixty of them are in it, or it has half of the rows.
///
/// Each channel has its own variance. The channels of an observable share one if any of them has fewer than four
/// degrees of freedom left. Channels with few degrees of freedom are moderated by the others, on the scale of noise
/// over range (moderation.hpp). The part that grows with the value is estimated by observable. Single outlying rows are
/// excluded. σ is never below the resolution of the values.
///
/// Any misfit that is as rough as noise from row to row counts as noise.
struct NoiseEstimate {
  std::vector<NoiseSource> sources;  ///< of all channels of the tests, in the order of the evidence
  EstimatedNoise from;               ///< in whitened rows of the evidence it came from; the span not orthonormal
};
NoiseEstimate encompassing_noise(const Evidence& evidence, const Fit& fit,
                                 const std::vector<const Eigen::VectorXd*>& signatures);

/// The evidence under these sources of noise. The base is fitted again from its last point, and `estimated` becomes the
/// basis of the estimate.
Evidence restated(const Inquiry& inquiry, const Evidence& evidence, const NoiseEstimate& estimate);

/// σ of every whitened row, 1 of rows that are no channel's; gross rows as their neighbours.
Eigen::VectorXd whitened_deviations(const Evidence& evidence);

}  // namespace tunica::diagnosis
