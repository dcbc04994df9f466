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

/// The basis of an estimated noise: the part of the whitened rows outside a span.
struct EstimatedNoise {
  Eigen::MatrixXd span;                  ///< orthonormal; no columns where nothing was estimated
  std::vector<std::size_t> group;        ///< by row: the variance that it has a share in; assembly::known_variance
  double moderation = 0;                 ///< degrees of freedom that the other channels add to each (moderation.hpp)
  std::vector<double> probability = {};  ///< of other ways in which the noise may grow with the level
  Eigen::MatrixXd variance = {};         ///< of a row (rows) if it grows so (columns), over what was taken
};

/// The evidence of the data about the base model: every channel has a noise, gross rows are silenced, the model is
/// fitted.
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

/// `gross`: rows to leave out. Throws InputError if data or names do not match, and BaseFitFailure if the base model
/// cannot be evaluated.
Evidence evidence_of(const Inquiry& inquiry, const std::vector<GrossRow>& gross);

/// The misfit of the base fit in the rows with stated noise, judged as in a run; without any such rows it is empty.
assembly::Misfit stated_misfit(const Evidence& evidence);

}  // namespace tunica::diagnosis
