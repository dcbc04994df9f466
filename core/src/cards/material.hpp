// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "plugins/catalogue.hpp"
#include "tunica/card_energy.hpp"

namespace tunica::cards {

/// A model with values for its parameters, as a card needs them.
struct Material {
  std::string type = {};                 ///< of the model: "yeoh"
  CardEnergy energy = {};                ///< moduli in kPa
  CardVolume volume = {"quadratic", 0};  ///< fitted; 0 = the fit is incompressible
  std::optional<CardSoftening> softening = {};
};

/// A model of an experiment, or a mechanism of it, by its type in the catalogue.
struct Ingredient {
  std::string type;
  Options options;
};

/// `values` in base units: of the model in the order of its description, then of the mechanisms, each in the order of
/// its declaration. Throws InputError where the model has no card, where a mechanism changes it in a way that no card
/// has, and where a value is not usable.
Material material_of(const plugins::Catalogue& catalogue, const Ingredient& model,
                     std::span<const Ingredient> mechanisms, std::span<const double> values);

[[nodiscard]] bool is_foam(const Material& material);
[[nodiscard]] bool has_fibres(const Material& material);

/// Whether a polynomial has these terms and no others: {{1, 0}, {0, 1}} is Mooney–Rivlin.
struct Powers {
  std::size_t m, n;
};
[[nodiscard]] bool consists_of(const PolynomialEnergy& energy, std::initializer_list<Powers> terms);
/// C_mn, 0 where there is no such term.
[[nodiscard]] double coefficient(const PolynomialEnergy& energy, std::size_t m, std::size_t n);
/// The largest m + n, and the largest n.
[[nodiscard]] std::size_t degree(const PolynomialEnergy& energy);
[[nodiscard]] std::size_t degree_in_second(const PolynomialEnergy& energy);

/// Whether E has the invariants of the Gasser–Ogden–Holzapfel energy only: κ = A, 1 − 3κ = B.
[[nodiscard]] bool without_normal(const FibreFamily& family);
/// Whether all families have the k1, k2, A and B of the first.
[[nodiscard]] bool alike(const FibreEnergy& energy);
/// Whether they are two alike families at ±angle.
[[nodiscard]] bool is_pair(const FibreEnergy& energy);
/// "strain", "stretch" or "none", as the option fibre_switch of models says it.
[[nodiscard]] std::string_view switch_words(const FibreEnergy& energy);

/// Throws InputError where a number is not finite, an exponent is 0, or there is no term.
void check(const Material& material);

/// The shear modulus at rest, kPa; with fibres the stiffness along the stiffest family that goes with it, μ + 4 k1.
/// Throws InputError where it is not positive: no program would find an equilibrium.
double stiffness_at_rest(const Material& material);

}  // namespace tunica::cards
