// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace tunica::es {

enum class Selection { plus, comma };
enum class Adaptation { isotropic, axes, covariance };
enum class StepControl { automatic, self_adaptive, cumulative };
enum class Infeasible { rank_by_violation, constant_penalty };
enum class Recombination { global, intermediate, discrete, none };
enum class Bounds { reflect, clamp, resample };

/// The options of the strategy, checked and typed; plugin.cpp declares them with their defaults. Lengths are
/// fractions of the unit box.
struct Settings {
  std::size_t parents = 0, offspring = 0;
  Selection selection = Selection::comma;
  Adaptation adaptation = Adaptation::covariance;
  StepControl step_control = StepControl::cumulative;  ///< `automatic` is resolved in plugin.cpp
  Recombination recombination = Recombination::global;
  Bounds bounds = Bounds::reflect;
  Infeasible infeasible = Infeasible::rank_by_violation;
  double initial_step = 0;
  std::size_t restarts = 0;
  double restart_growth = 1;          ///< factor on parents and offspring at every restart
  std::size_t stall_generations = 1;  ///< a search ends after this many generations without progress
  double tolerance = 0;               ///< relative improvement that counts as progress
  double step_tolerance = 0;          ///< a search ends when the mean mutation is shorter

  /// A search ends when the parents' objectives differ by less, relatively: only rounding is left to select by.
  static constexpr double alike = 1e-12;
};

}  // namespace tunica::es
