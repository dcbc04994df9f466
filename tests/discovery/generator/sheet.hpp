// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tissue.hpp"

namespace blind {

/// A thin sheet stretched along t and z, its faces free.
struct Sheet {
  enum class Kind { general, equibiaxial, pure_shear };  ///< the last is pulled along t
  std::string name;
  Kind kind = Kind::general;
  std::vector<double> time, around, along;  ///< s; stretches, as recorded
  [[nodiscard]] std::size_t channel_count() const { return kind == Kind::general ? 2 : 1; }
};

/// Cauchy stresses in kPa at every row: along t and z in general, their mean in equibiaxial extension, that along t in
/// pure shear.
std::vector<std::vector<double>> recorded_stresses(const Sheet& sheet, const Tissue& tissue);

}  // namespace blind
