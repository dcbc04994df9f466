// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "diagnosis/naming/refits.hpp"

namespace tunica::diagnosis {

/// One candidate as the only explanation.
struct Single {
  std::size_t candidate = 0;
  double log_weight = -INFINITY;
  std::size_t direction = 0;  ///< of the best refit; without one the likeliest by its score
  std::optional<Refit> best;  ///< none: too far behind to be fitted again, or no start could be evaluated
};

/// All candidates that leave a trace, those fitted again first, likeliest first.
///
/// With T_h = (s̃ᵀr)²/|s̃|² of hypothesis h (a place and nuisance values) at the null, or the gain of |r|² at finite
/// amplitude where it was fitted again (and beside such no larger part of T_h), the weight of a candidate is its
/// marginal likelihood with equal prior weight for its hypotheses and a wide prior on the amplitude in noise units,
///
///   w = mean over h of exp(T_h/2) · {1 two-sided, 2Φ(√T_h) one-sided};
///
/// single rows and whole curves of one candidate are two kinds of equal weight, however many rows there are.
std::vector<Single> fit_singles(const Inquiry& inquiry, const Analysis& analysis);

/// ln Σ exp
double log_sum(const std::vector<double>& logs);

}  // namespace tunica::diagnosis
