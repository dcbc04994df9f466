// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "population/population.hpp"

namespace tunica::population {

/// The distance of a specimen from the prediction of the others.
struct Standing {
  std::size_t specimen = 0;  ///< in the caller's order
  double distance = 0;       ///< Mahalanobis, of what its own data say of ξ against the prediction of the others
  std::size_t rank = 0;      ///< directions that its data fix
  double freedom = 0;        ///< of the others
  double p_value = 1;        ///< of one so far by chance
  double holm = 1;           ///< over all specimens
  std::size_t farthest = 0;  ///< the parameter that its shrunken effect is farthest in, in spreads
  bool outlying = false;     ///< holm < 0.05
};

/// Specimens, the farthest first. Each is left out once: variances and β are estimated anew without it, so that it
/// cannot hide behind a spread that it widened itself. With v its pull w + W(m − ξ₀) and V = W + W C W, C the
/// covariance of its predicted mean,
///
///   d² = v·V⁺v,   d²/r ~ F(r, ν − r + 1) ν/(ν − r + 1) for a full Ω (Hotelling), F(r, ν) for a diagonal one,
///
/// ν = specimens left − columns of the design. Nested: the animal's other specimens predict too. The second law is an
/// upper bound in the tail. Multiplicity: S. Holm, Scand. J. Stat. 6:65 (1979). Empty where the others are too few:
/// fewer than two, or a level of a factor would be empty.
std::vector<Standing> outliers(const Cohort& cohort, const Population& population);

}  // namespace tunica::population
