// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "population/population.hpp"

namespace tunica::population {

/// Every spread with its profile-likelihood interval on the expansions of the fit: where −2 log L, the other variances
/// searched anew, has risen by the quantile of χ² with one degree of freedom. `confidence` 0: no intervals.
std::vector<Spread> spreads(const Cohort& cohort, const Form& form, const Alternation& fit, double confidence);

}  // namespace tunica::population
