// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cohort/study.hpp"

namespace tunica::cohort {

/// What the specimens' own best fits give for each reading y, with its variance gᵀ(JᵀJ)⁺g, g = ∂y/∂ξ; and of all
/// together the mixed model of y, or of ln y where every y is above zero. Specimens are not helped by each other here:
/// a reading is fixed by a curve even where parameters are not.
std::vector<ReadingStudy> study_readings(const Specification& cohort, const Design& design, Likelihoods& likelihoods);

}  // namespace tunica::cohort
