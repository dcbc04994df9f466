// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tunica/model.hpp"

namespace tunica::conformance {

/// What evaluate_axes() answers.
struct AxesAnswers {
  std::vector<double> energy, gradient, hessian, gradient_dp, energy_dp;
};
/// Which outputs are asked for; those of derivatives only where the model declares them.
struct AxesSelection {
  bool energy = true, gradient = true, hessian = true, gradient_dp = true, energy_dp = true;
};

/// A call of evaluate_axes() at squared stretches, component-major. Throws std::runtime_error for a status that is not
/// ok, and MemoryFault (handout.hpp) for writes elsewhere or left out.
AxesAnswers axes_answers(const Model& model, std::span<const double> c, std::span<const double> parameters,
                         const AxesSelection& wanted = {});

}  // namespace tunica::conformance
