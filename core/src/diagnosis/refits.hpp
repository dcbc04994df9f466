// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// Refits the parameters with the additions, from what the linearisation says and from a smaller amplitude; none where
/// neither can be evaluated. `amplitudes` are differences from the nulls (even: squares). With `from`, a refit with all
/// additions but the last, first from where that one ended.
std::optional<Refitted> fit_with(const Diagnosis& diagnosis, std::vector<Addition> additions,
                                 std::span<const double> amplitudes, const plugins::Catalogue& catalogue,
                                 const Refitted* from = nullptr);

bool at_a_bound(const Fit& fit);

/// What a missing effect has driven to a bound of the base fit may stay there, though with the effect it is there no
/// longer: at θ = 0 two families of fibres are one, and no derivative leads away. Where the base fit has such a
/// parameter, the refit is searched for again from random places, and the better one stays.
void search_again(const Diagnosis& diagnosis, Refitted& refitted);

}  // namespace tunica::diagnosis
