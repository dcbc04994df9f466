// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cards/material.hpp"
#include "cards/unit_system.hpp"
#include "text/codes.hpp"

/// Material cards: the block of an input file that gives a finite-element program the model and its parameters.
/// docs/export.md derives every number of every card.
namespace tunica::cards {

enum class Target { febio, abaqus, ansys, calculix, lsdyna };

inline constexpr text::Codes<Target, 5> target_codes = {{{Target::febio, "febio"},
                                                         {Target::abaqus, "abaqus"},
                                                         {Target::ansys, "ansys"},
                                                         {Target::calculix, "calculix"},
                                                         {Target::lsdyna, "lsdyna"}}};

/// Throws InputError with the nearest name.
Target target_of(std::string_view name);

/// The contents of a card besides the model and its parameters.
struct CardSettings {
  /// The name of the material: a letter, then letters, digits, '_' or '-', at most 40 in all.
  std::string name = "TISSUE";
  UnitSystem units = {};
  /// Bulk modulus over the stiffness at rest (stiffness_at_rest()); 0 = incompressible, for programs that can have it.
  /// Nothing = the default of the program: 0 for Abaqus and Ansys, 1000 for LS-DYNA, 10000 for
  /// CalculiX and FEBio.
  std::optional<double> bulk_ratio = {};
  /// Mass density, kg/m³. LS-DYNA's cards need one, FEBio's may have one, the others have it elsewhere.
  std::optional<double> density = {};
  /// Abaqus: fibres by the user subroutine of uanisohyper_inv() instead of the energies that it has itself.
  bool subroutine = false;
  /// Put before the card as comments, one paragraph each: where the parameters come from, what they are good for.
  std::vector<std::string> remarks = {};
};

/// The card as text, each line ended; ASCII, without a date, the same for the same arguments. Throws InputError where
/// the program cannot express the model, with the reason, and where a setting or a parameter is not usable.
///
///     const PolynomialEnergy yeoh{{{1, 0, 180}, {2, 0, -1.5}, {3, 0, 0.05}}};
///     write_card(Target::calculix, {.type = "yeoh", .energy = yeoh}, {.units = unit_system("mm-N-MPa")})
std::string write_card(Target target, const Material& material, const CardSettings& settings = {});

/// The Fortran source of Abaqus' user subroutine UANISOHYPER_INV for every fibre model and every fibre_switch. It reads
/// the parameters from the card (CardSettings::subroutine).
std::string uanisohyper_inv();

}  // namespace tunica::cards
