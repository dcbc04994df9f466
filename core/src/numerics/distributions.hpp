// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Quantiles and tails. `freedom`: degrees of freedom, not necessarily whole, above 0.
namespace tunica::numerics {

double normal_quantile(double probability);
double student_quantile(double probability, double freedom);
double student_above(double x, double freedom);  ///< P(t > x)
double noncentral_student_above(double x, double freedom, double noncentrality);

double chi_squared_quantile(double probability, double freedom);
double chi_squared_below(double x, double freedom);  ///< P(χ² ≤ x)
double chi_squared_above(double x, double freedom);  ///< P(χ² > x)

/// The noncentrality λ at which P(χ²(λ) ≤ x) is `probability`; that of λ = 0 has to be larger.
double noncentrality_at(double x, double freedom, double probability);

/// P(F ≤ x) and P(F > x) of a ratio of two mean squares.
double f_below(double x, double freedom, double freedom_below);
double f_above(double x, double freedom, double freedom_below);

/// P(X ≥ successes) in so many independent trials.
double binomial_at_least(std::size_t successes, std::size_t trials, double probability);

}  // namespace tunica::numerics
