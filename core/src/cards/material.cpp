// SPDX-License-Identifier: Apache-2.0
#include "cards/material.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "data/nearest.hpp"
#include "plugins/guarded.hpp"
#include "tunica/error.hpp"

namespace tunica::cards {

namespace {

/// What a form holds, for check().
struct Numbers {
  std::vector<double> all, exponents;
};

template <class Term>
void add_powers(const std::vector<Term>& terms, Numbers& numbers) {
  for (const auto& term : terms) {
    numbers.all.push_back(term.mu);
    numbers.exponents.push_back(term.alpha);
  }
}

Numbers numbers_of(const PolynomialEnergy& energy) {
  Numbers numbers;
  for (const auto& term : energy.terms) numbers.all.push_back(term.coefficient);
  return numbers;
}
Numbers numbers_of(const LimitedChainEnergy& energy) { return {{energy.mu, energy.Jm}, {}}; }
Numbers numbers_of(const StretchEnergy& energy) {
  Numbers numbers;
  add_powers(energy.terms, numbers);
  return numbers;
}
Numbers numbers_of(const FoamEnergy& energy) {
  Numbers numbers;
  add_powers(energy.terms, numbers);
  for (const auto& term : energy.terms) numbers.all.push_back(term.nu);
  return numbers;
}
Numbers numbers_of(const FibreEnergy& energy) {
  Numbers numbers;
  for (const FibreFamily& one : energy.families)
    numbers.all.insert(numbers.all.end(), {energy.mu, one.angle, one.k1, one.k2, one.A, one.B});
  return numbers;
}

/// The model's entry, which declares an energy for cards.
const plugins::Catalogue::Entry<ModelFactory>& model_with_card(const plugins::Catalogue& catalogue,
                                                               const std::string& model) {
  const auto found = catalogue.models().find(model);
  if (found != catalogue.models().end() && found->second.factory.card) return found->second;
  std::vector<std::string> known;
  for (const auto& [name, entry] : catalogue.models())
    if (entry.factory.card) known.push_back(name);
  throw InputError(
      fmt::format("no card is known for the model '{}'. {}", data::excerpt(model), data::suggestion(model, known)));
}

double stiffness_of(const PolynomialEnergy& energy) {
  return 2 * (coefficient(energy, 1, 0) + coefficient(energy, 0, 1));
}
double stiffness_of(const LimitedChainEnergy& energy) { return energy.mu; }
double stiffness_of(const StretchEnergy& energy) {
  double stiffness = 0;
  for (const auto& term : energy.terms) stiffness += 0.5 * term.mu * term.alpha;
  return stiffness;
}
double stiffness_of(const FoamEnergy& energy) {
  double stiffness = 0;
  for (const auto& term : energy.terms) stiffness += term.mu;
  return stiffness;
}
double stiffness_of(const FibreEnergy& energy) {
  double k1 = 0;
  for (const auto& family : energy.families) k1 = std::max(k1, family.k1);
  return energy.mu + 4 * k1;
}

}  // namespace

Material material_of(const plugins::Catalogue& catalogue, const Ingredient& model,
                     std::span<const Ingredient> mechanisms, std::span<const double> values) {
  Material material{.type = model.type};
  const auto& declared = model_with_card(catalogue, model.type);
  for (std::size_t k = 0; k < mechanisms.size(); ++k) {
    const auto& entry = catalogue.mechanisms().find(mechanisms[k].type)->second;
    const MechanismFactory& mechanism = entry.factory;
    const bool known = mechanism.card_volume || mechanism.card_softening;
    if (!known || k > 0)
      throw InputError(
          fmt::format("the mechanism '{}' changes the model '{}', and no card has it{}. Fit a model that contains it, "
                      "or write the lines by hand: result.json has all parameters, and docs/export.md tells how for "
                      "laws that a program has itself",
                      mechanism.id, model.type, known ? " beside another one" : ""));
    const std::size_t own = mechanism.parameters_with(mechanisms[k].options).size();
    const auto part = [&](const char* name, const auto& formula) {
      return plugins::guarded(entry.plugin, name, [&] { return formula(mechanisms[k].options, values.last(own)); });
    };
    if (mechanism.card_volume) material.volume = part("card_volume", mechanism.card_volume);
    if (mechanism.card_softening) material.softening = part("card_softening", mechanism.card_softening);
    values = values.first(values.size() - own);
  }
  material.energy =
      plugins::guarded(declared.plugin, "card", [&] { return declared.factory.card(model.options, values); });
  return material;
}

bool is_foam(const Material& material) { return std::holds_alternative<FoamEnergy>(material.energy); }
bool has_fibres(const Material& material) { return std::holds_alternative<FibreEnergy>(material.energy); }

bool consists_of(const PolynomialEnergy& energy, std::initializer_list<Powers> terms) {
  return energy.terms.size() == terms.size() && std::ranges::all_of(terms, [&](const Powers& at) {
           return std::ranges::any_of(energy.terms, [&](const auto& term) { return term.m == at.m && term.n == at.n; });
         });
}

double coefficient(const PolynomialEnergy& energy, std::size_t m, std::size_t n) {
  double sum = 0;
  for (const auto& term : energy.terms)
    if (term.m == m && term.n == n) sum += term.coefficient;
  return sum;
}

std::size_t degree(const PolynomialEnergy& energy) {
  std::size_t most = 0;
  for (const auto& term : energy.terms) most = std::max(most, term.m + term.n);
  return most;
}

std::size_t degree_in_second(const PolynomialEnergy& energy) {
  std::size_t most = 0;
  for (const auto& term : energy.terms) most = std::max(most, term.n);
  return most;
}

bool without_normal(const FibreFamily& family) { return std::abs(1 - 3 * family.A - family.B) < 1e-12; }

bool alike(const FibreEnergy& energy) {
  const FibreFamily& first = energy.families.front();
  return std::ranges::all_of(energy.families, [&](const FibreFamily& one) {
    return one.k1 == first.k1 && one.k2 == first.k2 && one.A == first.A && one.B == first.B;
  });
}

bool is_pair(const FibreEnergy& energy) {
  return energy.families.size() == 2 && alike(energy) && energy.families[0].angle == -energy.families[1].angle;
}

std::string_view switch_words(const FibreEnergy& energy) {
  switch (energy.active) {
    case EnergyPart::Active::always:
      return "none";
    case EnergyPart::Active::argument_positive:
      return "strain";
    case EnergyPart::Active::fibre_stretched:
      return "stretch";
  }
  return "";
}

void check(const Material& material) {
  const Numbers numbers = std::visit([](const auto& energy) { return numbers_of(energy); }, material.energy);
  if (numbers.all.empty())
    throw InputError(fmt::format("model '{}': its card has no term; correct what its plugin declares", material.type));
  for (std::size_t k = 0; k < numbers.exponents.size(); ++k)
    if (numbers.exponents[k] == 0)
      throw InputError(
          fmt::format("model '{}': the exponent alpha_{} is 0, and every program divides by it; keep it off 0 by its "
                      "bounds, or leave the term out",
                      material.type, k + 1));
  for (const std::vector<double>& all : {numbers.all, numbers.exponents})
    for (const double value : all)
      if (!std::isfinite(value))
        throw InputError(
            fmt::format("model '{}': found {} in the energy of its card, expected finite numbers; check "
                        "the parameters",
                        material.type, value));
}

double stiffness_at_rest(const Material& material) {
  const double stiffness = std::visit([](const auto& energy) { return stiffness_of(energy); }, material.energy);
  if (stiffness > 0) return stiffness;
  throw InputError(
      fmt::format("model '{}': found a shear modulus of {:g} kPa at rest, expected one above 0; check the parameters",
                  material.type, stiffness));
}

}  // namespace tunica::cards
