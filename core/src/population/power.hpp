// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

namespace tunica::population {

/// Power of the two-sided t test at 5 % of two groups of n specimens each, whose estimates have the variance `variance`
/// each (between specimens and of the measurement), for a difference δ: with the noncentrality δ/√(2 variance/n) and
/// 2(n − 1) degrees of freedom (J. Cohen, Statistical Power Analysis, 1988, chapter 2).
double power(double difference, double variance, double specimens);

/// Specimens in each group that show the difference with 80 % power; none above 10 000.
std::optional<std::size_t> specimens_needed(double difference, double variance);

/// Smallest difference that n specimens in each group show with 80 % power.
double detectable_difference(double variance, double specimens);

}  // namespace tunica::population
