// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cohort_diagnosis/cohort_verdict.hpp"
#include "cohort_diagnosis/specimen_evidence.hpp"

namespace tunica::cohort_diagnosis {

/// How far the model misses the specimens, and whether that is worth caring about: as the file states it; else the
/// scatter between repeats; else what specimens differ by; else 2 % of the range.
CohortSize size_of(std::span<const SpecimenEvidence* const> specimens);

}  // namespace tunica::cohort_diagnosis
