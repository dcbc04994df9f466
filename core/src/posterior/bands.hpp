// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "posterior/draws.hpp"

namespace tunica::posterior {

/// Pointwise, one value a prediction, held-out rows included: 2.5, 50 and 97.5 % of the curve, and 2.5 and 97.5 % of
/// what would be measured there. The latter is NaN if the noise of a row is unknown.
struct Bands {
  std::vector<double> lower, median, upper;
  std::vector<double> lowest_measured, highest_measured;

  struct HeldOut {
    std::size_t rows = 0, inside = 0;  ///< measured, not fitted, with a noise; those within the band of measurements
  };
  HeldOut held_out;

  /// Of the draws, with a discrepancy: its size τ as a share of the range, and how many of them have none.
  struct Misfit {
    double lower = 0, median = 0, upper = 0;  ///< 2.5, 50, 97.5 %
    double none = 0;                          ///< share of the draws
  };
  std::optional<Misfit> misfit;
};

/// Most draws that are simulated again for the bands; evenly spaced.
constexpr std::size_t most_band_draws = 2000;

/// A measurement is y = ŷ(p) + s σ e, e normal, so that P(y ≤ c) is the mean of Φ((c − ŷ_k)/(s_k σ)) over the draws,
/// which is solved for c. σ of a fitted row is that of the likelihood. That of a held-out row is what is stated of it,
/// or else the median of its channel. Where the factor s is unknown, s_k² = ‖r_k‖²/χ²_N, its distribution in draw k.
/// With a discrepancy y = ŷ(p) + δ + s σ e, and δ of draw k is normal, with one τ, roughness and s by their probability
/// there. The curve is ŷ(p), without δ.
///
/// `complete` becomes false once `is_over` returns true.
Bands bands(const Question& question, const std::vector<Chain>& chains, const std::function<bool()>& is_over,
            bool& complete);

}  // namespace tunica::posterior
