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

  /// True over measured, and its derivatives by the amplitude and by the measured one.
  [[nodiscard]] double ratio(double measured) const { return scale + shift / measured; }
  [[nodiscard]] double ratio_slope(double measured) const { return scale_slope + shift_slope / measured; }
  [[nodiscard]] double ratio_by_measured(double measured) const { return -shift / (measured * measured); }
};
using Error = Correction (*)(double amplitude);

/// Which column of the abscissae is wrong; and a channel that was computed with it: data = (true/measured)^power ·
/// prediction.
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
