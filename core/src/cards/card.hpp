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

enum class Target { calculix, abaqus };

inline constexpr text::Codes<Target, 2> target_codes = {{{Target::calculix, "calculix"}, {Target::abaqus, "abaqus"}}};

/// Throws InputError with the nearest name.
Target target_of(std::string_view name);

/// What a card says beside the model and its parameters.
struct CardSettings {
  /// The name of the material: a letter, then letters, digits, '_' or '-', at most 40 in all.
  std::string name = "TISSUE";
  UnitSystem units = {};
  /// Bulk modulus over the stiffness at rest (stiffness_at_rest()); 0 = incompressible, for programs that can have it.
  /// Nothing = the default of the program: 0 for Abaqus, 10000 for CalculiX.
  std::optional<double> bulk_ratio = {};
  /// Put before the card as comments, one paragraph each: where the parameters come from, what they are good for.
  std::vector<std::string> remarks = {};
};

/// The card as text, each line ended; ASCII, without a date, the same for the same arguments. Throws InputError where
/// the program cannot express the model, with the reason, and where a setting or a parameter is not usable.
///
///     write_card(Target::calculix, {.type = "yeoh", .values = {{"c10", 180}, {"c20", -1.5}, {"c30", 0.05}}},
///                {.name = "RUBBER", .units = unit_system("mm-N-MPa")})
std::string write_card(Target target, const Material& material, const CardSettings& settings = {});

}  // namespace tunica::cards
