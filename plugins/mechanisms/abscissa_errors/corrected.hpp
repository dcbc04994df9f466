// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "tunica/test.hpp"

namespace tunica::abscissa_errors {

/// true = scale · measured + shift of one abscissa, and what the derivative by the amplitude a makes of a measured one:
/// ∂true/∂a = scale_slope · measured + shift_slope.
struct Correction {
  double scale = 1, shift = 0;
  double scale_slope = 0, shift_slope = 0;
};
using Error = Correction (*)(double amplitude);

/// Which column of the abscissae is wrong; and a channel that was computed with it: data = scale^power · prediction.
struct Where {
  std::size_t abscissa = 0;
  std::size_t channel = 0;
  int power = 0;  ///< 0 = no such channel
};

/// The base test at a corrected abscissa; the amplitude stands behind the base's own parameters, and has the null 0.
/// Derivatives are those of the base by its abscissa, times ∂true/∂a. Corrections may stand in one another: the inner
/// one corrects what the outer one has corrected.
std::unique_ptr<Test> corrected(std::unique_ptr<Test> base, const Parameter& amplitude, Error error, Where where);

}  // namespace tunica::abscissa_errors
