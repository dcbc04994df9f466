// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace tunica::diagnosis {

/// Moderation of the variances of several channels with few degrees of freedom by one another.
struct Moderation {
  double freedom = 0;  ///< prior degrees of freedom from the others; 0: none
  double ratio = 1;    ///< prior variance over the square of the reference
};

constexpr double least_freedom = 1.5;  ///< with fewer, a variance is not estimated from residuals at all

/// Empirical Bayes (G. K. Smyth, Stat. Appl. Genet. Mol. Biol. 3:3, 2004): with ratios s²/reference² of ν degrees of
/// freedom each, and their true values scattered as d/χ²_d about one ratio,
///
///   x = ln(s²/reference²) − ψ(ν/2) + ln(ν/2),   Var x = ψ′(ν/2) + ψ′(d/2);
///
/// each variance is then (ν s² + d s₀²)/(ν + d), of ν + d degrees of freedom. The scatter between channels is taken one
/// standard error above its estimate, so that d is rather too small. Fewer than four channels say nothing.
Moderation moderation_of(const std::vector<double>& ratios, const std::vector<double>& freedom);

}  // namespace tunica::diagnosis
