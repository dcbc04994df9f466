// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "solver.hpp"

namespace tunica::fe {

/// Observed at mid-length: outer and inner radius (mm), reduced axial force (mN).
using Observed = std::array<double, 3>;

/// Follows the equilibrium from rest, so that of several states it finds the one that loading leads to: a step is
/// predicted by the tangent, or along a line of pressures by Hermite extrapolation of the last two states, corrected by
/// Newton's method, and halved where that fails, moves the state far, or ends in an unstable equilibrium. Where the
/// pressure hardly rises with the volume such steps come to nothing: there it is the volume that is raised, until the
/// pressure is reached or stops rising, which is a limit pressure.
class Path {
 public:
  struct Limits {
    std::size_t steps = 1000;  ///< of the whole simulation
  };

  /// The solver has begun with the material.
  Path(Solver& solver, const Limits& limits);

  /// The equilibrium at rest.
  Status begin();
  /// From where it is to `to`. On failure it stays at the last equilibrium.
  Status go(const Load& to, Aim aim);

  [[nodiscard]] const Load& load() const { return load_; }
  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] Observed observed() const {
    return {solver_.outer_radius(state_), solver_.inner_radius(state_), solver_.axial_force()};
  }
  [[nodiscard]] std::size_t steps() const { return steps_; }

  /// Back to an equilibrium found before; the next step starts with its tangent.
  struct Mark {
    Load load;
    State state;
  };
  [[nodiscard]] Mark mark() const { return {load_, state_}; }
  Status return_to(const Mark& mark);

 private:
  void predict(const Load& to, State& guess);
  [[nodiscard]] Status stuck(const std::string& why, const Load& load, const State& state) const;
  Status step(const Load& to, Aim aim);
  Status accept(const Load& to, Aim aim);
  Status fill(const Load& to, Aim aim);
  Solver& solver_;
  Limits limits_;
  Load load_, before_;
  State state_, slope_, previous_, previous_slope_, stretch_slope_, guess_;
  bool has_previous_ = false;  ///< the last step was one of pressure alone
  std::size_t steps_ = 0;
};

}  // namespace tunica::fe
