// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/naming/explanation.hpp"

namespace tunica::diagnosis {

/// What explains the residuals of the base fit: verdict, claim, ranking.
///
/// The ambiguity set holds the likeliest explanations, with 92.5 % of the probability together, look-alikes counted
/// once (credible.hpp). Pairs are tried beside single mechanisms (groups.hpp), and a third where the best pair leaves
/// something; where no explanation leaves clean residuals, or too many do, the cause is unknown.
Explanation named_causes(const Inquiry& inquiry, const Analysis& analysis);

/// The same explanation where the extension leaves what is not noise: unknown, with the share that the causes take, and
/// how much larger than it is stated the noise would have to be for the rest to be clean. Where the alarm stands at
/// that noise too, the causes may be all there is.
Explanation unclean(const Inquiry& inquiry, const Analysis& analysis, Explanation explanation);

}  // namespace tunica::diagnosis
