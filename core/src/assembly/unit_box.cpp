// SPDX-License-Identifier: Apache-2.0
#include "assembly/unit_box.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::assembly {

UnitBox::UnitBox(const std::vector<FreeParameter>& parameters) {
  for (const FreeParameter& free : parameters) {
    const bool logarithmic = free.scale != Scale::linear;
    axes_.push_back({free.min, free.max, logarithmic ? std::log(free.min) : 0,
                     logarithmic ? std::log(free.max / free.min) : 0, logarithmic});
    initial_.push_back(free.initial);
  }
}

UnitBox UnitBox::between(std::span<const double> lower, std::span<const double> upper) const {
  std::vector<double> least(axes_.size()), largest(axes_.size());
  from_unit(lower, least);
  from_unit(upper, largest);
  UnitBox part = *this;
  for (std::size_t j = 0; j < axes_.size(); ++j) {
    Axis& axis = part.axes_[j];
    axis.min = least[j];
    axis.max = largest[j];
    axis.log_min += lower[j] * axis.log_span;
    axis.log_span *= upper[j] - lower[j];
    part.initial_[j] = std::clamp(initial_[j], axis.min, axis.max);
  }
  return part;
}

void UnitBox::from_unit(std::span<const double> x, std::span<double> free) const {
  for (std::size_t j = 0; j < axes_.size(); ++j) {
    const Axis& axis = axes_[j];
    const double value =
        axis.logarithmic ? std::exp(axis.log_min + x[j] * axis.log_span) : axis.min + x[j] * (axis.max - axis.min);
    free[j] = x[j] <= 0   ? axis.min
              : x[j] >= 1 ? axis.max
                          : std::clamp(value, axis.min, axis.max);  // not out by rounding
  }
}

void UnitBox::to_unit(std::span<const double> free, std::span<double> x) const {
  for (std::size_t j = 0; j < axes_.size(); ++j) {
    const Axis& axis = axes_[j];
    const double unit = axis.logarithmic ? (std::log(free[j]) - axis.log_min) / axis.log_span
                                         : (free[j] - axis.min) / (axis.max - axis.min);
    x[j] = std::clamp(unit, 0.0, 1.0);
  }
}

std::vector<double> UnitBox::initial() const {
  std::vector<double> x(axes_.size());
  to_unit(initial_, x);
  return x;
}

double UnitBox::slope(std::size_t parameter, double value) const {
  const Axis& axis = axes_[parameter];
  return axis.logarithmic ? value * axis.log_span : axis.max - axis.min;
}

void UnitBox::jacobian_to_unit(std::span<const double> free, std::span<double> jacobian) const {
  // A few columns at a time: their slopes then need no allocation.
  constexpr std::size_t most = 16;
  double slopes[most];
  const std::size_t n = axes_.size();
  for (std::size_t first = 0; first < n; first += most) {
    const std::size_t count = std::min(most, n - first);
    for (std::size_t j = 0; j < count; ++j) slopes[j] = slope(first + j, free[first + j]);
    for (std::size_t row = first; row < jacobian.size(); row += n)
      for (std::size_t j = 0; j < count; ++j) jacobian[row + j] *= slopes[j];
  }
}

}  // namespace tunica::assembly
