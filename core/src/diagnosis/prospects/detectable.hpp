// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/detection/analysis.hpp"

namespace tunica::diagnosis {

/// For every mechanism the least amplitude that these data would show with 80 % power at the level alpha, where it
/// shows best (of several nuisance settings the one in the middle),
///
///   Λ = (√T_α + 0.84)²,  δ = √Λ/|s̃|   (even: δ² in place of δ),
///
/// and the least that they would tell from the mechanism most like it, projected correlation c, Λ = 5.41/(1 − |c|);
/// infinite where |c| > 0.999.
std::vector<Detectable> detectable(const Inquiry& inquiry, const Analysis& analysis);

}  // namespace tunica::diagnosis
