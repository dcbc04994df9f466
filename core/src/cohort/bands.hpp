// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cohort/likelihoods.hpp"
#include "cohort/study.hpp"

namespace tunica::cohort {

/// The predictive bands of every group, at the rows and with the geometry of the group's first specimen:
///
///   mean: the curve of the mean material, f(B x);
///   band: 2.5 % and 97.5 % of f(ξ) over draws of a new specimen of a new animal (population/predictive.hpp).
///
/// Why not the mean of the specimens' curves: a curve is not linear in ξ, so that the mean of curves is the curve of no
/// material, and at stretches that only some specimens reached it is the mean of those only.
std::vector<Band> bands_of(const Members& members, const population::Population& population,
                           const Likelihoods& likelihoods, std::uint64_t seed);

}  // namespace tunica::cohort
