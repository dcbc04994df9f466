// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cohort_diagnosis/hypotheses.hpp"

namespace tunica::cohort_diagnosis {

struct Pair {
  std::size_t a = 0, b = 0;  ///< hypotheses
  double log_evidence = 0;   ///< over nothing
  double needed = 0;         ///< ln of what it is likelier than the better one of the two alone
};

/// The pairs of mechanisms that could be at work together, likeliest first. With the amplitudes (x, y) of a specimen,
///
///   ℓ(x, y) = u x + v y − (a²x² + 2 c a b x y + b²y²)/2,
///
/// c being the cosine of what the two leave after a refit, and each amplitude from a population of its own. All pairs
/// are compared by the gain at their best amplitudes; of the best, ℓ is integrated. It is taken along the vectors in
/// which the residuals show the effects, so that it never gains more than there is.
std::vector<Pair> pairs_of(const Specimens& specimens, const std::vector<Hypothesis>& hypotheses);

/// One amplitude of a pair in one specimen: u, a, and whether it is cut off at the null, and on which side.
struct Leg {
  double u = 0, length = 0;
  double cut = 0;  ///< 1: amplitudes above 0 only; −1: below; 0: both
};
/// ln ∫∫ exp ℓ over both populations; `cosine` between the directions of rising amplitudes.
double log_marginal(const Leg& a, const Leg& b, double cosine, const Population& of_a, const Population& of_b);

/// The cosine between rising amplitudes of two hypotheses in a specimen, and the legs.
double cosine_of(const SpecimenEvidence& specimen, const Profile& a, const Profile& b);
Leg leg_of(const Profile& profile);

}  // namespace tunica::cohort_diagnosis
