// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/file/corrected_fits.hpp"

namespace tunica::diagnosis {

/// Corrections with an amplitude, fitted together with all parameters of the base. Those with the largest score at the
/// null are fitted. A correction that ends at a bound or is implausible explains nothing and is left out. A fit pays ln
/// n per amplitude, as in BIC.
std::vector<CorrectedFit> calibrated_fits(const Inquiry& inquiry, const Analysis& analysis, const Record& record,
                                          const Corrections& corrections);

}  // namespace tunica::diagnosis
