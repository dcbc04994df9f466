// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace tunica {

/// Declares that a model's memory consists only of Maxwell branches; a class derived from Model may also derive from
/// this. In principal axes, with g_a = ½ S_aa of elastic() and c_a the squared stretches,
///
///   g'_a = g_a − ⅓ (Σ_b g_b c_b)/c_a,   h₊ = e^{−Δt/τ} h + g φ Δg',  φ = (1 − e^{−Δt/τ})/(Δt/τ),
///
/// h = 0 at rest, and the response is g_a plus the h_a of all branches. remember() computes this row by row. With this
/// declaration, a test may compute all rows of a path at once, with the same numbers to rounding.
///
/// Threads: as Model. Ownership: none.
class MaxwellModel {
 public:
  MaxwellModel() = default;
  MaxwellModel(const MaxwellModel&) = delete;
  MaxwellModel& operator=(const MaxwellModel&) = delete;
  virtual ~MaxwellModel() = default;

  /// Places of g (relative stiffness) and τ (s) among the parameters of the whole model.
  struct Branch {
    /// Place of the relative stiffness.
    std::size_t g;
    /// Place of the relaxation time, s.
    std::size_t tau;
  };
  /// Adds its branches; false if the model has any other memory.
  virtual bool add_branches(std::vector<Branch>& found) const = 0;
};

}  // namespace tunica
