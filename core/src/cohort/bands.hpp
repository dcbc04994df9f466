// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cohort/study.hpp"

namespace tunica::cohort {

/// The predictive bands of every group, at the rows and with the geometry of the group's first specimen:
///
///   mean: the curve of the mean material, f(B x);
///   band: 2.5 % and 97.5 % of f(ξ) over ξ ~ N(B x, Ω + Ω_a + cov B x), a new specimen of a new animal.
///
/// Why not the mean of the specimens' curves: a curve is not linear in ξ, so that the mean of curves is the curve of no
/// material, and at stretches that only some specimens reached it is the mean of those only.
std::vector<Band> bands_of(const Design& design, const PopulationFit& fit, const Likelihoods& likelihoods,
                           std::uint64_t seed);

}  // namespace tunica::cohort
