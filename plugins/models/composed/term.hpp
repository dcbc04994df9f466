// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "law_table.hpp"

namespace tunica::composed {

/// The argument of a term. docs/plugins/composed.md has the formulas.
enum class Quantity {
  first_invariant,   ///< I1 − 3
  second_invariant,  ///< I2 − 3
  fibre,             ///< E of a family, its squared stretch less 1 without dispersion
  coupling,          ///< M1·C M2 − cos 2θ of the two families at ±θ
  radial,            ///< C_rr − 1, across the wall
  across,            ///< M·C e_r, shear between a family and the normal of the wall
  stretches,         ///< Σ over the principal stretches (Ogden)
  product,           ///< (I1 − 3)^m (I2 − 3)^n with m + n = 2 or 3
  volume,            ///< J − 1
};
enum class Family { axial, circumferential, diagonal, single };
enum class Dispersion { none, rotational, two_planes };

/// One entry of "terms", checked.
struct Term {
  std::string name;
  Quantity quantity = Quantity::first_invariant;
  bool isochoric = false;  ///< of C̄ = J^(−2/3) C in the place of C
  Family family = Family::diagonal;
  Dispersion dispersion = Dispersion::none;
  EnergyPart::Active active = EnergyPart::Active::always;
  std::string angle_of;                           ///< the term whose angle it shares; empty = its own, where it has one
  Law law;                                        ///< empty for stretches
  std::size_t first_power = 0, second_power = 0;  ///< m and n of a product

  /// Whether only a material that changes its volume can have it.
  [[nodiscard]] bool changes_volume() const { return isochoric || quantity == Quantity::volume; }
  [[nodiscard]] bool isotropic() const {
    return quantity == Quantity::first_invariant || quantity == Quantity::second_invariant ||
           quantity == Quantity::stretches || quantity == Quantity::product || quantity == Quantity::volume;
  }
  /// Whether it depends on an angle that is a parameter.
  [[nodiscard]] bool is_angled() const {
    return quantity == Quantity::coupling || (has_family() && (family == Family::diagonal || family == Family::single));
  }
  [[nodiscard]] bool has_family() const { return quantity == Quantity::fibre || quantity == Quantity::across; }
  /// Whether it represents two families, at ±θ.
  [[nodiscard]] bool is_pair() const { return has_family() && family == Family::diagonal; }
};

/// The words that "invariant" may be, in the order of the documentation.
std::vector<std::string> invariant_words();

/// From the JSON text of the option "terms". Throws InputError that says which term, what was found and what to do.
std::vector<Term> read_terms(const std::string& json);

/// JSON Schema of the option, for completion in editors.
std::string terms_schema();

}  // namespace tunica::composed
