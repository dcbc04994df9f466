// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "population/linear_model.hpp"

namespace tunica::population {

struct Maximum {
  std::vector<double> x;  ///< Coordinates
  double value = 0;       ///< −2 log L
  bool converged = false;
};

/// The variances of the largest likelihood, by SLSQP of NLopt with exact gradients, from x. `held`: a coordinate that
/// keeps its value. Spreads start at 0.05 scales at least: at a spread of zero the gradient vanishes, whether or not it
/// is a minimum. Afterwards ∂F/∂Ω_jj < 0 at a spread of zero starts the search once more from above.
Maximum maximise(const LinearModel& model, const Coordinates& coordinates, std::vector<double> x,
                 std::optional<std::size_t> held = {});

}  // namespace tunica::population
