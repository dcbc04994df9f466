// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tissue.hpp"

namespace blind {

/// A strip pulled along one material axis, its faces free: λ2 from σ2 = σ3 by bracketing.
struct Strip {
  Material::First direction = Material::First::circumferential;
  std::vector<double> time, stretch;  ///< s; as recorded
  std::string name = {};
};

/// What may be wrong with a strip and its load cell, each at its null.
struct StripFaults {
  double reference_length = 0;  ///< true stretch = recorded (1 + this)
  double gain = 0, offset = 0;  ///< recorded stress = true (1 + gain) + offset
  double misalignment = 0;      ///< degrees
  double set = 0;               ///< rest length = 1 + this (largest recorded stretch so far − 1); slack below it
  double bend = 0;              ///< outside the catalogue: recorded = true (1 + bend · true/largest)
  double slip = 0;              ///< outside: true stretch = recorded less this times the share of the largest stretch²
  double friction = 0;          ///< outside: kPa, with the sign of the stretch rate
  double clamp = 0;             ///< outside: share of the lateral contraction that the grips prevent
};

/// Recorded Cauchy stress at every row in kPa; NaN from where there is no equilibrium.
std::vector<double> recorded_stress(const Strip& strip, const Tissue& tissue, const StripFaults& faults);

}  // namespace blind
