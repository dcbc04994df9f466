// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// P(χ² > |r|²) of a fit, for shapes that are neither smooth nor those of a mechanism. It is 1 unless all noise is
/// stated and the probability is below 1e-6. Noise slightly larger than stated also raises |r|², so only very small
/// probabilities count.
double p_of_squares(const Evidence& evidence, const Fit& fit);

}  // namespace tunica::diagnosis
