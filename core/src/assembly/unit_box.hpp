// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "assembly/layout.hpp"

namespace tunica::assembly {

/// Unit box ↔ free parameters: linear, p = min + x (max − min), or logarithmic, p = min (max/min)^x.
class UnitBox {
 public:
  explicit UnitBox(const std::vector<FreeParameter>& parameters);

  /// The part of the box between two corners, as a new unit box.
  [[nodiscard]] UnitBox between(std::span<const double> lower, std::span<const double> upper) const;

  void from_unit(std::span<const double> x, std::span<double> free) const;
  void to_unit(std::span<const double> free, std::span<double> x) const;
  [[nodiscard]] std::vector<double> initial() const;
  /// dp/dx of one parameter at its value: max − min, or p log(max/min).
  [[nodiscard]] double slope(std::size_t parameter, double value) const;
  /// Turns a Jacobian by the free parameters, row-major, into one by the unit box.
  void jacobian_to_unit(std::span<const double> free, std::span<double> jacobian) const;

 private:
  /// p = min + x·(max − min), or p = exp(log_min + x·log_span).
  struct Axis {
    double min, max, log_min, log_span;
    bool logarithmic;
  };
  std::vector<Axis> axes_;
  std::vector<double> initial_;  ///< values
};

}  // namespace tunica::assembly
