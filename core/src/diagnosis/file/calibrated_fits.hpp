// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/file/corrected_fits.hpp"

namespace tunica::diagnosis {

/// Corrections with an amplitude, fitted beside all parameters of the base: those whose signature at the null sees most
/// of the residuals. What ends at a bound, or beyond what is plausible, explains nothing and is left out. A fit pays ln
/// n a amplitude, as in BIC.
std::vector<CorrectedFit> calibrated_fits(const Inquiry& inquiry, const Analysis& analysis, const Record& record,
                                          const Corrections& corrections);

}  // namespace tunica::diagnosis
