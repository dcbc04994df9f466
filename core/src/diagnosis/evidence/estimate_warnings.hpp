// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// Warnings about unstated noise: the source of each channel's σ, the channels where differences of neighbouring rows
/// contradict it by more than chance, and whether errors of rows are correlated. `best` is the fit whose residuals gave
/// the noise.
std::vector<Warning> estimate_warnings(const Evidence& evidence, const Fit& best);

/// P-value of the difference between an estimated σ and that of neighbouring rows, under independence; 1 if one of them
/// is missing.
double contradiction(const NoiseSource& source);

}  // namespace tunica::diagnosis
