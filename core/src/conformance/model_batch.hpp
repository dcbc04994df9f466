// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "conformance/material_point.hpp"
#include "tunica/model.hpp"

namespace tunica::conformance {

/// Whether two numbers are the same one; two that are none are.
inline bool same(double a, double b) { return a == b || (a != a && b != b); }
inline bool same(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!same(a[i], b[i])) return false;
  return true;
}

/// Which outputs are asked for.
struct OutputSelection {
  bool energy = true, stress = true, tangent = true, stress_dp = true, state = true;
};

/// A call of evaluate(): several points with the same parameters; of models with history from an old state, in time.
struct Batch {
  std::size_t count = 0;
  std::vector<double> C, p, time_step, state;

  /// Seeded states and parameters at which the model is finite point by point.
  static Batch draw(const Model& model, Sampler& sampler, std::size_t n);
  [[nodiscard]] MaterialPoints points() const { return {count, C, p, time_step, state}; }
  [[nodiscard]] Point point(std::size_t i) const;
};

/// All answers one behind the other: energy, stress, tangent, stress_dp, state; of the kinds wanted only. Throws
/// std::runtime_error for a status that is not ok, and MemoryFault (handout.hpp) for writes elsewhere or left out.
std::vector<double> answers(const Model& model, const Batch& batch, const OutputSelection& wanted = {});

}  // namespace tunica::conformance
