// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tunica::cards {

/// A consistent system of units: the stress is the force over the square of the length. Time is in seconds.
struct UnitSystem {
  std::string length = "mm", force = "N", stress = "MPa";
  double stress_per_kPa = 1e-3;      ///< what 1 kPa is
  double density_per_kg_m3 = 1e-12;  ///< what 1 kg/m³ is, in force s²/length⁴

  [[nodiscard]] std::string name() const { return length + "-" + force + "-" + stress; }
};

/// "mm-N-MPa": length, force, stress, in any spelling that data files may have. Throws InputError where a unit is not
/// known, or the three do not go together, with what would.
UnitSystem unit_system(std::string_view text);

/// A mass density in kg/m³, from text with a unit. A number alone is refused: some mean kg/m³, others the units of the
/// card. Throws InputError.
double density_of(const std::string& text);

}  // namespace tunica::cards
