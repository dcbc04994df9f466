// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cohort_diagnosis/cohort_verdict.hpp"
#include "cohort_diagnosis/hypotheses.hpp"

namespace tunica::cohort_diagnosis {

/// Mean and spread of the amplitude over those specimens for which `counts` holds. The mean of a population that is cut
/// off at the null is that of what is left of it. Over a grid of populations, all as likely before the data as their
/// steps in m and ln τ are wide: median and 95 % of the mean, median of the spread.
CommonAmplitude common_amplitude(const Hypothesis& hypothesis, const std::vector<bool>& counts);

}  // namespace tunica::cohort_diagnosis
