// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "assembly/assembly.hpp"
#include "assembly/misfit.hpp"
#include "diagnosis/evidence/curves.hpp"
#include "diagnosis/evidence/least_squares.hpp"
#include "diagnosis/evidence/noise_statement.hpp"
#include "diagnosis/request.hpp"
#include "diagnosis/result.hpp"

namespace tunica::diagnosis {

/// What the noise of some channels was estimated from: the rest of their whitened rows, outside a span.
struct EstimatedNoise {
  Eigen::MatrixXd span;                  ///< orthonormal; no columns where nothing was estimated
  std::vector<std::size_t> group;        ///< by row: the variance that it has a share in; assembly::known_variance
  double moderation = 0;                 ///< degrees of freedom that the other channels add to each (moderation.hpp)
  std::vector<double> probability = {};  ///< of other ways in which the noise may grow with the level
  Eigen::MatrixXd variance = {};         ///< of a row (rows) if it grows so (columns), over what was taken
};

/// What the data say of the base model: noise stated for every channel, gross rows silenced, the model fitted.
struct Evidence {
  experiment::Experiment experiment;  ///< with noise stated for every channel
  experiment::RunEntry run;
  std::vector<NoiseSource> noise;
  std::vector<GrossRow> gross;  ///< rows that every fit leaves out
  std::shared_ptr<const assembly::Assembly> base;
  std::vector<Curve> curves;
  Fit fit;  ///< of the base
  std::vector<Warning> warnings;
  EstimatedNoise estimated = {};
  std::vector<Warning> noise_warnings = {};  ///< of what the noise was taken from
};

/// `gross`: rows to leave out. Throws InputError where data or names do not fit, BaseFitFailure where the base model
/// cannot be evaluated.
Evidence evidence_of(const Inquiry& inquiry, const std::vector<GrossRow>& gross);

/// How far the base fit misses the rows whose noise is stated, judged as a run judges it; of no rows where none is.
assembly::Misfit stated_misfit(const Evidence& evidence);

}  // namespace tunica::diagnosis
