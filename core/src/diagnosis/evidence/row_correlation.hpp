// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// How alike errors of neighbouring rows are, and its standard deviation where they are independent.
struct RowCorrelation {
  double value = 0, sd = 0;
};

/// Lag-1 autocorrelation of what a fit leaves outside the span of the noise estimate, over the channels it is estimated
/// for, rows of a hold among them. With P the projector, M = ½ between neighbours of a curve, D = 1 on their rows and
/// K = M − D tr(PM)/tr(PD), whose mean under independent rows is 0:
///
///   ρ = rᵀPKPr / 2 tr(PKPK),   sd² = 1 / 2 tr(PKPK);
///
/// the projection, which by itself makes neighbours unlike, is so accounted for. None where nothing is estimated.
std::optional<RowCorrelation> row_correlation(const Evidence& evidence, const Fit& fit);

}  // namespace tunica::diagnosis
