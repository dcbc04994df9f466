// SPDX-License-Identifier: Apache-2.0
#include "dial.hpp"

#include <algorithm>
#include <cmath>

namespace blind {

Refit refit_with(const Specimen& specimen, const NoiseModel& noise, const std::vector<HiddenEffect>& hidden,
                 const Tissue& start) {
  const auto y = observe(specimen.protocol, world_with(specimen, hidden));
  for (const double value : y) {
    if (std::isfinite(value)) continue;
    Refit lost;
    lost.tissue = specimen.tissue;
    lost.misfit = std::numeric_limits<double>::infinity();
    return lost;
  }
  return refit(specimen.protocol, noise.about(specimen.protocol, y), y, start);
}

/// √Λ is a power of the distance from the null: the first at small distances, the second for even effects. The power is
/// read off the last two trials; a bracket keeps the trials in order.
ScaledEffect dial(const Specimen& specimen, const NoiseModel& noise, HiddenEffect hidden, double lambda) {
  constexpr double tolerance = 0.01;
  double low = 0, high = hidden.largest, power = hidden.effect->even ? 2 : 1;
  double before = 0, root_before = 0;
  bool bounded = false;  // the upper end of the bracket is known to show too much
  ScaledEffect best{hidden, 0, true};
  hidden.distance = 0.01 * hidden.largest;
  for (int trial = 0; trial < 30; ++trial) {
    const double found = refit_with(specimen, noise, {hidden}, specimen.tissue).misfit;
    if (!std::isfinite(found)) {
      high = hidden.distance;
      bounded = true;
      hidden.distance = 0.5 * (low + high);
      before = 0;
      continue;
    }
    if (trial == 0 || std::abs(found - lambda) < std::abs(best.lambda - lambda)) best = {hidden, found, true};
    if (std::abs(found / lambda - 1) < tolerance) return best;
    if (found < lambda && hidden.distance >= hidden.largest) break;
    if (found < lambda)
      low = hidden.distance;
    else {
      high = hidden.distance;
      bounded = true;
    }
    const double root = std::sqrt(found);
    if (before > 0 && root != root_before) {
      const double read = std::log(root / root_before) / std::log(hidden.distance / before);
      if (std::isfinite(read)) power = std::clamp(read, 0.4, 4.0);
    }
    before = hidden.distance;
    root_before = root;
    double next = hidden.distance * std::clamp(std::pow(std::sqrt(lambda / found), 1 / power), 0.02, 20.0);
    if (bounded && !(next > low && next < high)) next = 0.5 * (low + high);
    hidden.distance = std::min(next, hidden.largest);
    if (bounded && high - low < 1e-6 * high) break;
  }
  best.reached = false;
  return best;
}

}  // namespace blind
