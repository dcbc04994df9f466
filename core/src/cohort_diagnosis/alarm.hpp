// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cohort_diagnosis/hypotheses.hpp"

namespace tunica::cohort_diagnosis {

/// P-value of the cohort from those of its specimens, each calibrated by itself (R. A. Fisher, Statistical Methods for
/// Research Workers, 1932, § 21.1):
///
///   −2 Σ ln p ~ χ²(2n).
///
/// A p-value of few draws is a step: half a step is added where none was worse.
double p_of_cohort(const Specimens& specimens);

}  // namespace tunica::cohort_diagnosis
