// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>

#include <boost/math/tools/roots.hpp>

namespace blind {

/// Root of a function that rises through it, near `guess`: the bracket is widened until it holds a change of sign, then
/// TOMS 748. NaN where none is found within `reach`.
template <class Function>
double rising_root(const Function& f, double guess, double step, double reach) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double low = guess, high = guess, f_low = f(guess), f_high = f_low;
  if (!std::isfinite(f_low)) return none;
  for (; f_low > 0; step *= 2) {
    high = low;
    f_high = f_low;
    low -= step;
    f_low = f(low);
    if (guess - low > reach || !std::isfinite(f_low)) return none;
  }
  for (; f_high < 0; step *= 2) {
    double next = high + step, f_next = f(next);
    for (int shorter = 0; !std::isfinite(f_next) && shorter < 20; ++shorter) {
      step /= 2;
      next = high + step;
      f_next = f(next);
    }
    if (next - guess > reach || !std::isfinite(f_next)) return none;
    low = high;
    f_low = f_high;
    high = next;
    f_high = f_next;
  }
  if (f_low == 0) return low;
  if (f_high == 0) return high;
  std::uintmax_t budget = 100;
  const auto tolerance = [](double a, double b) { return b - a < 1e-12; };
  const auto [a, b] = boost::math::tools::toms748_solve(f, low, high, f_low, f_high, tolerance, budget);
  return 0.5 * (a + b);
}

}  // namespace blind
