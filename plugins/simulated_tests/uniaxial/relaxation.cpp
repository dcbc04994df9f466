// SPDX-License-Identifier: Apache-2.0
#include "relaxation.hpp"

#include <algorithm>

#include "tunica/detail/vector_math.hpp"

namespace tunica::uniaxial {
namespace {

/// 1 − e^{−x}, where cancellation would cost digits by its series Σ (−1)^k x^{k+1}/(k+1)!, to 3e-16.
inline double lost_after(double x) {
  double series = 0;
  for (int k = 9; k >= 1; --k) series = x * (1.0 / k) * (1 - series);
  const double plain = 1 - detail::lane_exp(-x);
  return x < 0.1 ? series : plain;
}

}  // namespace

void Relaxation::set(std::span<const double> time, std::size_t first, std::size_t count, double tau) {
  for (auto* const column : {&decay, &taken, &by_tau, &by_tau_of_h})
    if (column->size() < count) column->resize(count);
  decay[0] = (first > 0 ? time[first] - time[first - 1] : std::max(0.0, time[0])) / tau;
  detail::vectorised([=, t = time.data() + first, keep = decay.data(), take = taken.data(), by = by_tau.data(),
                      of_h = by_tau_of_h.data()] {
    TUNICA_LANES
    for (std::size_t i = 1; i < count; ++i) keep[i] = (t[i] - t[i - 1]) / tau;
    TUNICA_LANES
    for (std::size_t i = 0; i < count; ++i) {
      const double x = keep[i], lost = lost_after(x);
      keep[i] = 1 - lost;
      take[i] = x > 0 ? lost / x : 1;
      by[i] = (take[i] - keep[i]) / tau;
      of_h[i] = x * keep[i] / tau;
    }
  });
}

}  // namespace tunica::uniaxial
