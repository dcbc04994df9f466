// SPDX-License-Identifier: Apache-2.0
#include "strip.hpp"

#include <algorithm>

#include "root.hpp"

namespace blind {
namespace {

constexpr int substeps = 24;  ///< between two rows, where the material remembers

class Path {
 public:
  Path(const Material& material, double clamp) : material_(material), clamp_(clamp), memory_(material.at_rest()) {}

  /// Cauchy stress at the stretch, `dt` after the last one.
  double follow(double stretch, double dt) {
    const double c1 = stretch * stretch;
    const auto point = [c1](double y) { return Triple{c1, std::exp(y), std::exp(-y) / c1}; };
    const auto lateral = [&](double y) {
      const Triple c = point(y), S = stress(c, dt, nullptr);
      return c[1] * S[1] - c[2] * S[2];
    };
    // The bulk of the strip contracts as 1/√λ.
    y_ = rising_root(lateral, y_ - std::log(stretch / last_), 0.01, 4);
    last_ = stretch;
    const Triple c = point(clamp_ == 0 ? y_ : (1 - clamp_) * y_), S = stress(c, dt, &memory_);
    return c[0] * S[0] - c[2] * S[2];
  }

 private:
  Triple stress(const Triple& c, double dt, Memory* fresh) const {
    if (!material_.remembers()) return material_.elastic(c);
    const Memory old = memory_;
    return material_.with_memory(c, old, dt, fresh);
  }

  const Material& material_;
  double clamp_, y_ = 0, last_ = 1;
  Memory memory_;
};

}  // namespace

std::vector<double> recorded_stress(const Strip& strip, const Tissue& tissue, const StripFaults& faults) {
  const Material material(tissue, strip.direction, faults.misalignment);
  Path path(material, faults.clamp);
  const double largest = *std::max_element(strip.stretch.begin(), strip.stretch.end());
  const auto truth = [&](double recorded) {
    const double share = (recorded - 1) / (largest - 1);
    return recorded * (1 + faults.reference_length) - faults.slip * share * share;
  };
  std::vector<double> stress;
  double before = 1, clock = 0, farthest = 1;
  for (std::size_t i = 0; i < strip.stretch.size(); ++i) {
    farthest = std::max(farthest, strip.stretch[i]);
    const double rest = 1 + faults.set * (farthest - 1), whole = truth(strip.stretch[i]), dt = strip.time[i] - clock;
    const bool slack = rest > 1 && whole <= rest;
    const double now = slack ? 1 : whole / rest;
    const int steps = material.remembers() && dt > 0 ? substeps : 1;
    double sigma = 0;
    for (int k = 1; k <= steps; ++k) sigma = path.follow(before + (now - before) * k / steps, dt / steps);
    // Force over the reference area is what the cell gives; the recorded stretch makes it a Cauchy stress.
    // After a set the section that it left counts.
    stress.push_back(slack ? 0 : sigma * strip.stretch[i] / whole);
    before = now;
    clock = strip.time[i];
  }
  const double strongest = *std::max_element(stress.begin(), stress.end());
  for (std::size_t i = 0; i < stress.size(); ++i) {
    double& value = stress[i];
    if (faults.bend != 0) value *= 1 + faults.bend * value / strongest;
    value = value * (1 + faults.gain) + faults.offset;
    if (faults.friction == 0 || i == 0) continue;
    const double rate = strip.stretch[i] - strip.stretch[i - 1];
    value += faults.friction * (rate > 0 ? 1 : rate < 0 ? -1 : 0);
  }
  return stress;
}

}  // namespace blind
