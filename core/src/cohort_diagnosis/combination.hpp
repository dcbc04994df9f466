// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cohort_diagnosis/cohort_verdict.hpp"
#include "cohort_diagnosis/specimen_evidence.hpp"

namespace tunica::cohort_diagnosis {

/// One verdict on all specimens: docs/cohort_diagnosis.md says how. The order in which they come does not matter, not
/// even to the last bit. Throws InputError for no specimen, for two of one id, and for a factor that has no level for
/// a specimen.
CohortVerdict combine(std::span<const SpecimenEvidence> specimens, std::span<const Factor> factors = {},
                      const Request& request = {});

}  // namespace tunica::cohort_diagnosis
