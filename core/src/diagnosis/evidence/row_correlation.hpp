// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// The correlation of errors in neighbouring rows, and its standard deviation under independence.
struct RowCorrelation {
  double value = 0, sd = 0;
};

/// Lag-1 autocorrelation of what a fit leaves outside the span of the noise estimate, over the channels it is estimated
/// for, rows of a hold among them. With P the projector, M = ½ between neighbours of a curve, D = 1 on their rows and
/// K = M − D tr(PM)/tr(PD), whose mean under independent rows is 0:
///
///   ρ = rᵀPKPr / 2 tr(PKPK),   sd² = 1 / 2 tr(PKPK);
///
/// This corrects for the projection, which by itself makes neighbours less alike. None if no noise is estimated.
std::optional<RowCorrelation> row_correlation(const Evidence& evidence, const Fit& fit);

}  // namespace tunica::diagnosis
