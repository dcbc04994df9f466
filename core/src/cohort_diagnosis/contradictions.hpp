// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cohort_diagnosis/cohort_verdict.hpp"
#include "cohort_diagnosis/hypotheses.hpp"

namespace tunica::cohort_diagnosis {

/// The specimens that do not go with the explanation, each with its strongest reason. Each is judged by the population
/// that the others of its group have. `affected`: those that should show the effect. `all` are rivals to it.
std::vector<Contradiction> contradictions_of(const Specimens& specimens, const std::vector<const Hypothesis*>& causes,
                                             const std::vector<Hypothesis>& all, const std::vector<bool>& affected);

}  // namespace tunica::cohort_diagnosis
