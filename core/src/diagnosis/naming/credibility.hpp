// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/naming/groups.hpp"

namespace tunica::diagnosis {

inline constexpr double odds_against = 20;  ///< an amplitude that is not credible

/// Whether every amplitude of a refit is plausible and off its bound.
bool is_credible(const Inquiry& inquiry, const Analysis& analysis, const Refit& refit,
                 const std::vector<std::size_t>& directions);

/// What is believed of amplitudes enters the weights, which then order anew what was fitted. The odds are twenty to one
/// against an amplitude that is not credible. Beside a credible explanation that leaves only noise, the others together
/// weigh a twentieth of it at most.
void weigh_credibility(const Inquiry& inquiry, const Analysis& analysis, std::vector<Single>& singles);
void weigh_credibility(const Inquiry& inquiry, const Analysis& analysis, std::vector<Group>& groups);

}  // namespace tunica::diagnosis
