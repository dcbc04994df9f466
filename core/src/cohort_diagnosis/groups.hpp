// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cohort_diagnosis/cohort_verdict.hpp"
#include "cohort_diagnosis/hypotheses.hpp"

namespace tunica::cohort_diagnosis {

/// The specimens of one level of one factor.
struct Level {
  std::size_t factor = 0;
  std::string name;
  std::vector<bool> has;  ///< by specimen
};
/// The levels of all factors, by name; of a factor with one level none. Throws InputError where a specimen has none.
std::vector<Level> levels_of(const Specimens& specimens, std::span<const Factor> factors);

/// ln of the evidence of a hypothesis where the whole cohort may have the effect, or one level of one factor alone: of
/// ten effects eight are in all, and the levels share the others.
double log_evidence(const Hypothesis& hypothesis, const std::vector<Level>& levels, std::size_t specimens);

/// What every factor has to do with the effect.
std::vector<FactorEvidence> factors_of(const Hypothesis& hypothesis, const std::vector<Level>& levels,
                                       std::span<const Factor> factors, std::size_t specimens);

/// Those that have the effect: of the one level that alone has it, or all.
std::vector<bool> affected(const std::vector<FactorEvidence>& factors, const std::vector<Level>& levels,
                           std::size_t specimens);

}  // namespace tunica::cohort_diagnosis
