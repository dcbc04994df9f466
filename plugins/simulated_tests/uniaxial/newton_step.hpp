// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace tunica::uniaxial {

/// What passes along a path write, row by row; y = ln λ2² is looked for.
struct PathRows {
  std::span<double> u;                ///< λ2²
  std::span<double> stress;           ///< σ11 with the last step in it
  std::span<double> stress_dp, y_dp;  ///< total derivatives by parameter j of row i at [j·n + i]
};

/// Newton's step in y where r is at_step and dr/dy is −1/by_residual; the same damping for all kinds of memory.
struct NewtonStep {
  // Its error is the square of the step before, so that behind a step of `near` the derivatives by parameters can be
  // taken at once; they are taken again where a kink between left more than `settled`.
  static constexpr double near = 1e-5, settled = 1e-9, farthest = 1e10, least = -0.6, greatest = 1.5;
  static constexpr int most = 40;  ///< iterations
  double largest = 0;              ///< of all rows
  bool sound = true;               ///< no row was lost
  [[gnu::always_inline]] double take(double at_step, double slope, double by_residual, bool rests, double& before) {
    if (rests) return before = 0;
    return damped(at_step * by_residual, slope, before);
  }
  /// Of a row that does not rest.
  [[gnu::always_inline]] double damped(double step, double slope, double& before) {
    sound = sound && slope > 0 && std::abs(step) < farthest;
    largest = std::max(largest, std::abs(step));
    step = std::clamp(step, least, greatest);
    // Where fibres switch, steps may go to and fro across the kink.
    if (step * before < 0 && std::abs(step) > 0.5 * std::abs(before)) step *= 0.5;
    return before = step;
  }
  /// The same of many rows; false where damped() would damp one, and then nothing is noted.
  [[gnu::always_inline]] bool undamped(std::span<const double> step, std::span<const double> slope,
                                       std::span<double> before) {
    double far = 0, no_slope = 0, clamped = 0, across = 0;
    for (std::size_t i = 0; i < step.size(); ++i) {
      const double size = std::abs(step[i]);
      far = std::max(far, size);
      no_slope += slope[i] > 0 && size < farthest ? 0 : 1;
      clamped += step[i] >= least && step[i] <= greatest ? 0 : 1;
      across += step[i] * before[i] < 0 && size > 0.5 * std::abs(before[i]) ? 1 : 0;
    }
    if (clamped + across > 0) return false;
    std::copy(step.begin(), step.end(), before.begin());
    largest = std::max(largest, far);
    sound = sound && no_slope == 0;
    return true;
  }
};

}  // namespace tunica::uniaxial
