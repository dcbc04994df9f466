// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace tunica::data {

/// A curve at fewer points than it was measured at.
struct Smoothed {
  std::vector<double> values;  ///< one a point; NaN where no measured value lies near
  double scatter = 0;          ///< standard deviation of the measured values about the curve
  double error = 0;            ///< root mean square standard deviation that it leaves in `values`
  double correlation = 0;      ///< of the errors of neighbouring points, on average
};

/// Local linear regression of y over x at the points `at`, with tricube weights over ± `reach` (W. S. Cleveland, J. Am.
/// Stat. Assoc. 74:829, 1979), no iterations:
///
///   ŷ(t) = Σ l_i(t) y_i,   l_i = w_i (S₂ − S₁ u_i)/(S₀ S₂ − S₁²),   u_i = x_i − t,   S_k = Σ w_i u_i^k,
///   w_i = (1 − |u_i/h|³)³,  h = reach, or as much as three measured values need.
///
/// The scatter is σ² = Σ (y_i − ŷ(x_i))²/Σ (1 − 2 l_i(x_i) + ‖l(x_i)‖²), so ŷ(t) has the standard deviation σ‖l(t)‖,
/// and neighbouring points share l(t₁)·l(t₂)/(‖l(t₁)‖‖l(t₂)‖) of their errors. NaN among the y count as not measured.
Smoothed local_regression(std::span<const double> x, std::span<const double> y, std::span<const double> at,
                          double reach);

}  // namespace tunica::data
