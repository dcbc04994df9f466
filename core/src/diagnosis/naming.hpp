// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// What explains the residuals of the base fit: fills causes, ambiguity set, alternatives, verdict and extension.
///
/// Every candidate c has hypotheses h: targets and nuisance values. With T_h = (s̃ᵀr)²/|s̃|² at the null, or the gain of
/// |r|² at finite amplitude where it was fitted again, the weight of a candidate is its marginal likelihood with equal
/// prior weight for its hypotheses and a wide prior on the amplitude in noise units,
///
///   w_c = mean over h of exp(T_h/2) · {1 two-sided, 2Φ(√T_h) one-sided},
///
/// and its probability w_c/Σw. The ambiguity set holds the candidates with 2 ln(w_best/w_c) ≤ set_width.
///
/// Residuals that stay after the best one are tested like those of the base fit; where they are not clean, all pairs
/// are tried, each member of which must lose significantly when it is taken out, and then a third.
void name_causes(Diagnosis& diagnosis, const Detection& detection, const Eigen::MatrixXf& draws, const Shapes& shapes,
                 const plugins::Catalogue& catalogue);

/// Calibrated on the development seed of the blind benchmark, see docs/diagnosis.md.
constexpr double set_width = 5.4;
constexpr double second_alpha = 0.01;  ///< false alarms of residuals that have been explained once

/// Refits the parameters with the additions, from what the linearisation says and from a smaller amplitude; none where
/// neither can be evaluated.
std::optional<Refitted> fit_with(const Diagnosis& diagnosis, std::vector<Addition> additions,
                                 std::span<const double> amplitudes, const plugins::Catalogue& catalogue);

}  // namespace tunica::diagnosis
