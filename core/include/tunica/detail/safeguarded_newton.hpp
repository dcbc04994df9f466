// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

/// Kernels that several plugins share: numerics without mechanics.
namespace tunica::detail {

/// r and its derivative at some y.
struct Residual {
  double value,  ///< r(y); not finite where the energy overflows
      slope;     ///< dr/dy
};

/// Root of r(y) by Newton's method inside a bracket, from a start where r is finite. r is expected to rise through
/// the root that is looked for. Overflow is walked around: a step into it is halved until it ends where r is finite.
/// Returns false when no bracket is found, or where r overflows at the start or inside the bracket. Where r jumps from
/// one sign to the other, it ends at the jump; a caller that expects jumps must check r there.
template <class Function>
bool safeguarded_newton(const Function& function, double& y, double tolerance = 1e-14) {
  Residual r = function(y);
  if (!std::isfinite(r.value)) return false;
  if (r.value == 0) return true;
  // Bracket: walk downhill in |r|, doubling the step; where that ends in overflow, halve it.
  double low = y, high = y, step = r.value > 0 ? -0.05 : 0.05;
  bool bracketed = false;
  for (int trial = 0; trial < 200 && !bracketed; ++trial) {
    const double from = r.value > 0 ? low : high;
    const double next = from + step;
    const Residual at = function(next);
    if (!std::isfinite(at.value)) {
      step *= 0.5;
      if (std::abs(step) < 1e-12) return false;
      continue;
    }
    (r.value > 0 ? low : high) = next;
    bracketed = r.value > 0 ? at.value <= 0 : at.value >= 0;
    if (!bracketed) (r.value > 0 ? high : low) = next;
    step *= 2;
  }
  if (!bracketed) return false;
  // Newton, with bisection wherever it leaves the bracket or the slope is of no use.
  for (int iteration = 0; iteration < 200; ++iteration) {
    r = function(y);
    if (!std::isfinite(r.value)) return false;
    if (r.value == 0) return true;
    (r.value > 0 ? high : low) = y;
    double next = y - r.value / r.slope;
    if (!(r.slope > 0) || !(next > low && next < high)) next = 0.5 * (low + high);
    const double change = std::abs(next - y);
    y = next;
    if (change <= tolerance * (1 + std::abs(y))) return true;
  }
  return high - low <= 1e-10;
}

}  // namespace tunica::detail
