// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace tunica::ceres_lm {

enum class Sampling { latin_hypercube, sobol };

/// The options of the method, checked and typed; plugin.cpp declares them with their defaults.
struct Settings {
  std::size_t starts;
  Sampling sampling;
  int max_iterations;        ///< of one descent
  int screening_iterations;  ///< of every start before the best are continued; 0 = no screening
  std::size_t polished;      ///< starts that are continued after screening
  double function_tolerance, gradient_tolerance, parameter_tolerance;
};

}  // namespace tunica::ceres_lm
