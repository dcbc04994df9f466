// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cohort_diagnosis/cohort_verdict.hpp"
#include "cohort_diagnosis/hypotheses.hpp"

namespace tunica::cohort_diagnosis {

/// What the cause leaves of each affected specimen, with an amplitude of its own, and with the mean of the others,
/// which have never seen it; of more than twenty specimens a twentieth is left out at a time. Amplitudes are those of
/// the parabolas, all other parameters being fitted again:
///
///   |r|² − 2 ℓ(y),   2 ℓ(y) = 2 t a y − (a y)².
std::vector<LeftOut> left_out(const Specimens& specimens, const Hypothesis& cause, const std::vector<bool>& affected);

}  // namespace tunica::cohort_diagnosis
