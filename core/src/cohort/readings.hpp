// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cohort/likelihoods.hpp"
#include "cohort/study.hpp"

namespace tunica::cohort {

/// What the specimens' own best fits give for each reading y, with its variance gᵀ(JᵀJ)⁺g, g = ∂y/∂ξ; and the
/// population of all readings together, of ln y where every y is above zero. Specimens are not helped by each other
/// here: a reading is fixed by a curve even where parameters are not.
ReadingsStudy study_readings(const Specification& cohort, const Members& members, Likelihoods& likelihoods,
                             std::uint64_t seed);

}  // namespace tunica::cohort
