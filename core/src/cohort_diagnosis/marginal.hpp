// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cohort_diagnosis/profile.hpp"

namespace tunica::cohort_diagnosis {

/// From where the amplitudes of the specimens come: distances from the null, normal about `mean`; of one side only
/// where the mechanism has one, and then cut off at the null.
struct Population {
  double mean = 0, sd = 1;
};

/// ln of the likelihood of one specimen over that of its base, its amplitude integrated over the population:
///
///   ln ∫ exp(ℓ(y)) N(y; m, τ²) dy,   ℓ(y) = t a y − (a y)²/2 on each side of the null;
///
/// on one side, with D = 1 + τ²a² and u = t a,
///
///   −½ ln D + (u²τ² + 2 u m − m²a²)/(2D) + ln Φ(μ/s),   μ = (m + τ²u)/D,  s = τ/√D.
///
/// Cut off, the normal distribution is divided by what is left of it, Φ(m/τ).
double log_marginal(const Profile& profile, const Population& population);

/// ln Φ(z), for any z.
double log_normal_below(double z);

/// How a hypothesis shows in the cohort: A = 1/√(mean a²) over the specimens that see it, the largest t, and the sides.
struct Extent {
  double unit = 1, largest_score = 0;
  bool up = false, down = false;
};

/// Populations of equal weight before the data: √(m² + τ²) is between 1 A and 25 A (or the largest score, if that is
/// larger) in equal steps of its logarithm, τ a fifth of that to all of it, and the mean on either admissible side.
std::vector<Population> populations(const Extent& scale, bool coarse = false);

/// Likelihoods of specimens that share a hypothesis, one row a specimen, one column a population. A specimen may be
/// none of the cohort: with a chance of `stranger` it has no part in the effect.
constexpr double stranger = 0.01;
double log_with_strangers(double log_likelihood);

}  // namespace tunica::cohort_diagnosis
