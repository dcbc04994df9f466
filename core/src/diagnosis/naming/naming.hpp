// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/naming/explanation.hpp"

namespace tunica::diagnosis {

/// Whether terms of the energy can be searched for: there is one model to add them to, and the request leaves out
/// neither the catalogue nor the group "material".
bool can_search_terms(const Request& request, const Evidence& evidence, const plugins::Catalogue& catalogue);

/// The explanation of the base fit's residuals: verdict, claim, ranking.
///
/// The ambiguity set holds the likeliest explanations, with 92.5 % of the probability together, look-alikes counted
/// once (credible.hpp). Pairs are tried beside single mechanisms (groups.hpp), and a third where the best pair leaves
/// something; where no explanation leaves clean residuals, or too many do, the cause is unknown.
Explanation named_causes(const Inquiry& inquiry, const Analysis& analysis);

/// The same explanation if the extension leaves more than noise. The verdict is then unknown, with the share that the
/// causes explain and the factor on the stated noise at which the rest would be clean. If the alarm also holds at that
/// noise, the causes may be complete.
Explanation unclean(const Inquiry& inquiry, const Analysis& analysis, Explanation explanation);

}  // namespace tunica::diagnosis
