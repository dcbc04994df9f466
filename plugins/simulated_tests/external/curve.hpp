// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tunica/status.hpp"

namespace tunica::external {

/// A curve through the points of a solver: cubic pieces whose slopes are weighted means of the neighbouring secants
/// (modified Akima interpolation), straight lines where there are fewer than four points.
class Curve {
 public:
  /// Abscissae all rising or all falling, as many ordinates; `problem` says otherwise.
  Curve(std::vector<double> x, std::vector<double> y);
  [[nodiscard]] const std::string& problem() const { return problem_; }
  /// Whether x lies within the points, up to rounding of the solver's numbers.
  [[nodiscard]] bool reaches(double x) const;
  [[nodiscard]] double operator()(double x) const;
  [[nodiscard]] double slope(double x) const;
  [[nodiscard]] double first() const { return first_; }
  [[nodiscard]] double last() const { return last_; }

 private:
  [[nodiscard]] double inside(double x) const;
  std::string problem_;
  double first_ = 0, last_ = 0;
  std::function<double(double)> value_, slope_;
};

}  // namespace tunica::external
