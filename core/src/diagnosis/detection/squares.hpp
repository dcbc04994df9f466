// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// P(χ² > |r|²) of a fit, for shapes that are neither smooth nor those of a mechanism; 1 unless all noise is stated and
/// the probability is below 1e-6. It takes noise that is a little larger than stated for a misfit, and therefore counts
/// only where it is beyond doubt.
double p_of_squares(const Evidence& evidence, const Fit& fit);

}  // namespace tunica::diagnosis
