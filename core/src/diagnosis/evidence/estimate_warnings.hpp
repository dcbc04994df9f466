// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// What a reader has to know of noise that nobody stated: where σ of each channel is from, which channels the
/// differences of neighbouring rows contradict by more than chance, and whether rows share their errors. `best`: the
/// fit whose residuals it was taken from.
std::vector<Warning> estimate_warnings(const Evidence& evidence, const Fit& best);

/// P-value of so large a difference between an estimated σ and that of neighbouring rows, taken as independent; 1 where
/// one of them is missing.
double contradiction(const NoiseSource& source);

}  // namespace tunica::diagnosis
