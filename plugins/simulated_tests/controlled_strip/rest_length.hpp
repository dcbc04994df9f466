// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace tunica::controlled_strip {

/// The permanent set of a strip: its rest length grows with the largest stretch Λ so far, p = 1 + s (Λ − 1), and the
/// material feels λ/p (Diani, Fayolle, Gilormini, Eur. Polym. J. 45:601, 2009). At s = 0 nothing changes.
struct RestLength {
  double s = 0, largest = 1;  ///< s and Λ

  [[nodiscard]] double ratio() const { return 1 + s * (largest - 1); }

  /// ln λ of what is measured where the material feels l, and its derivatives. Beyond Λ the row itself is the largest,
  /// λ = λ_felt (1 − s)/(1 − s λ_felt).
  struct Measured {
    double l, by_felt, by_s, by_largest;
    bool leads;
  };
  [[nodiscard]] Measured measured(double felt) const {
    const double p = ratio(), stretch = std::exp(felt);
    if (s == 0) return {felt, 1, stretch > largest ? stretch - 1 : largest - 1, 0, stretch > largest};
    if (!(stretch * p > largest)) return {felt + std::log(p), 1, (largest - 1) / p, s / p, false};
    const double left = 1 - s * stretch;
    return {felt + std::log1p(-s) - std::log(left), 1 / left, stretch / left - 1 / (1 - s), 0, true};
  }

  /// What the material feels of a measured stretch, and its derivatives. Below its rest length a strip is slack; pushed
  /// below its first length it is as it was.
  struct Felt {
    double stretch, by_measured, by_s, by_largest;
    bool slack;
  };
  [[nodiscard]] Felt felt(double stretch) const {
    const bool leads = stretch > largest;
    const double grown = (leads ? stretch : largest) - 1, p = 1 + s * grown;
    if (stretch < p && p > 1) return {std::min(stretch, 1.0), stretch < 1 ? 1.0 : 0.0, 0, 0, stretch >= 1};
    return {stretch / p, (1 - (leads ? stretch * s / p : 0)) / p, -stretch * grown / (p * p),
            leads ? 0 : -stretch * s / (p * p), false};
  }
};

}  // namespace tunica::controlled_strip
