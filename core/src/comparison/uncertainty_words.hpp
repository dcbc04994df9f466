// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "comparison/summary.hpp"
#include "uncertainty/bootstrap.hpp"
#include "uncertainty/profile.hpp"

namespace tunica::comparison {

/// Puts first which linearised intervals may be far off, and where to find better ones: in the profile where there is
/// one already.
void add_linearised_words(RunSummary& summary);

/// Where χ² contradicts the stated noise: by how much the intervals are wider for it, and that the bootstrap is better
/// still, or is there.
void add_widening_words(RunSummary& summary);

/// What a reader of the intervals must know: ends that stay open, profiles that disagree with the linearised intervals
/// (an end elsewhere by more than a quarter of their half width), a centre that was no optimum, refits that failed.
void add_profile_words(const assembly::Assembly& assembly, const std::vector<uncertainty::Profile>& profiles,
                       RunSummary& summary);

/// Failed draws, and where neighbouring residuals were so alike that blocks of them were drawn.
void add_bootstrap_words(const assembly::Assembly& assembly, const uncertainty::Bootstrap& bootstrap,
                         RunSummary& summary);

}  // namespace tunica::comparison
