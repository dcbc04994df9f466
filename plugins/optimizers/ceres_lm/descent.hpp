// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "settings.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::ceres_lm {

/// How far one descent came.
struct Descent {
  enum class End {
    converged,  ///< a tolerance was met
    out_of_iterations,
    blocked,     ///< no step, however short, could be evaluated
    infeasible,  ///< the constraints could not be met from here
    stopped,     ///< should_stop()
    not_started  ///< the first point could not be evaluated
  };
  std::vector<double> x;  ///< best point that could be evaluated, feasible before infeasible; else the first
  double objective = 0;   ///< undefined when not started
  double violation = 0;   ///< of the constraints; 0 = feasible
  End end = End::stopped;
  std::string failure = {};  ///< reason of the last failed evaluation

  bool evaluated = false;  ///< x could be evaluated
};

/// Bounded Levenberg–Marquardt from x; with constraints, of the augmented Lagrangian (augmented_lagrangian.hpp), whose
/// multipliers follow in between. A step into a point that cannot be evaluated is shortened.
Descent descend(Problem& problem, std::span<const double> x, int max_iterations, const Settings& settings);

}  // namespace tunica::ceres_lm
