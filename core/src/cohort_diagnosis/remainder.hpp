// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cohort_diagnosis/hypotheses.hpp"

namespace tunica::cohort_diagnosis {

/// What an explanation leaves of the smooth shapes of one specimen: Q = |b − C (CᵀC)⁻¹…|² of the part of b that its
/// vectors do not take, on `freedom` degrees of freedom, and its p-value.
struct Rest {
  double Q = 0, freedom = 0;
  [[nodiscard]] double p() const;
};
Rest rest_of(const SpecimenEvidence& specimen, const std::vector<const Profile*>& causes);

/// Of all specimens together: Σ Q against χ² of Σ freedom. A specimen that does not see a cause keeps its shapes.
Rest rest_of(const Specimens& specimens, const std::vector<const Hypothesis*>& causes);

}  // namespace tunica::cohort_diagnosis
