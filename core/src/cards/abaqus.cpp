// SPDX-License-Identifier: Apache-2.0
// Abaqus Keywords Guide: *HYPERELASTIC, *ANISOTROPIC HYPERELASTIC; Materials Guide: "Hyperelastic behavior of
// rubberlike materials", "Anisotropic hyperelastic behavior".
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cards/comment.hpp"
#include "cards/writers.hpp"

namespace tunica::cards {

namespace {

std::string keyword_line(std::string_view form) { return fmt::format("*HYPERELASTIC, {}\n", form); }

/// U = Σ C_mn (Ī1 − 3)^m (Ī2 − 3)^n + Σ (J − 1)^2i/D_i, the sum complete to degree N.
std::string abaqus_polynomial(const Draft& draft, const PolynomialEnergy& energy, std::size_t highest) {
  const std::size_t N = degree(energy);
  if (N > highest)
    throw CannotExpress{fmt::format("its polynomials end with degree {}, and this one has {}", highest, N),
                        "fit fewer constants"};
  std::vector<double> values;
  for (std::size_t sum = 1; sum <= N; ++sum)
    for (std::size_t n = 0; n <= sum; ++n) values.push_back(draft.stress * coefficient(energy, sum - n, n));
  values.push_back(draft.d1());
  values.resize(values.size() + N - 1, 0.0);
  return keyword_line(fmt::format("POLYNOMIAL, N={}", N)) + data_lines(values);
}

// U = C10 (Ī1 − 3) + (J − 1)²/D1, and with more terms.
std::string polynomial_keyword(const Draft& draft, const PolynomialEnergy& energy, std::size_t highest) {
  const auto C = [&](std::size_t m, std::size_t n) { return draft.stress * coefficient(energy, m, n); };
  const double d1 = draft.d1();
  if (consists_of(energy, {{1, 0}})) return keyword_line("NEO HOOKE") + data_lines(std::vector{C(1, 0), d1});
  if (consists_of(energy, {{1, 0}, {0, 1}}))
    return keyword_line("MOONEY-RIVLIN") + data_lines(std::vector{C(1, 0), C(0, 1), d1});
  if (consists_of(energy, {{1, 0}, {2, 0}, {3, 0}}))
    return keyword_line("YEOH") + data_lines(std::vector{C(1, 0), C(2, 0), C(3, 0), d1, 0.0, 0.0});
  return abaqus_polynomial(draft, energy, highest);
}

// U = Σ 2 μ_i/α_i² (λ̄1^α_i + λ̄2^α_i + λ̄3^α_i − 3) + Σ (J − 1)^2i/D_i: their μ_i is ½ μ_i α_i here.
std::string ogden_keyword(const Draft& draft, const StretchEnergy& energy, std::size_t most_terms) {
  const auto& terms = energy.terms;
  if (terms.size() > most_terms)
    throw CannotExpress{fmt::format("it takes {} terms at most, and these are {}", most_terms, terms.size()),
                        "fit fewer terms"};
  std::vector<double> values;
  for (const auto& term : terms) values.insert(values.end(), {0.5 * draft.stress * term.mu * term.alpha, term.alpha});
  values.push_back(draft.d1());
  values.resize(3 * terms.size(), 0.0);
  return keyword_line(fmt::format("OGDEN, N={}", terms.size())) + data_lines(values);
}

std::string orientation(const FibreEnergy& energy, bool normal) {
  std::string block = comment("**",
                              "Fibres: local direction 1 is the circumferential, 2 the axial, 3 the radial one. The "
                              "section needs an orientation with the directions of the families; this one has them for "
                              "a wall whose circumferential direction is x and whose axial one is y:");
  block += fmt::format("** *ORIENTATION, NAME=WALL, LOCAL DIRECTIONS={}\n** 1, 0, 0, 0, 1, 0\n** 3, 0\n",
                       energy.families.size() + normal);
  for (const auto& family : energy.families) {
    const double angle = family.angle * std::numbers::pi / 180;
    block += fmt::format("** {}, {}, 0\n", number(std::sin(angle)), number(std::cos(angle)));
  }
  if (normal) block += "** 0, 0, 1\n";
  return block;
}

/// For uanisohyper_inv(): mu, D, the switch, and k1, k2, A, B of every family; the normal of the wall as the last local
/// direction where an energy has it.
std::string by_subroutine(const Draft& draft, const FibreEnergy& energy) {
  const double mode = energy.active == EnergyPart::Active::argument_positive ? 0
                      : energy.active == EnergyPart::Active::fibre_stretched ? 1
                                                                             : 2;
  std::vector<double> properties = {draft.stress * energy.mu, draft.d1(), mode};
  bool normal = false;
  for (const auto& family : energy.families) {
    properties.insert(properties.end(), {draft.stress * family.k1, family.k2, family.A, family.B});
    normal = normal || !without_normal(family);
  }
  return orientation(energy, normal) +
         fmt::format(
             "*MATERIAL, NAME={}\n*ANISOTROPIC HYPERELASTIC, USER, FORMULATION=INVARIANT, TYPE={},\n"
             "LOCAL DIRECTIONS={}, PROPERTIES={}\n",
             draft.settings.name, draft.bulk > 0 ? "COMPRESSIBLE" : "INCOMPRESSIBLE", energy.families.size() + normal,
             properties.size()) +
         data_lines(properties);
}

// U = C10 (Ī1 − 3) + 1/D [(J² − 1)/2 − ln J] + k1/(2 k2) Σ {exp[k2 ⟨Ē⟩²] − 1},  Ē = κ (Ī1 − 3) + (1 − 3κ) (Ī4 − 1).
std::string holzapfel(const Draft& draft, const FibreEnergy& energy) {
  if (!alike(energy)) throw CannotExpress{"the HOLZAPFEL energy has one k1 and one k2 for all families", ""};
  if (energy.families.size() > 3) throw CannotExpress{"the HOLZAPFEL energy has three families at most", ""};
  const FibreFamily& family = energy.families.front();
  if (!without_normal(family))
    throw CannotExpress{"the HOLZAPFEL energy lacks the stretch along the normal of the wall", ""};
  if (energy.active == EnergyPart::Active::always ||
      (energy.active == EnergyPart::Active::fibre_stretched && family.A > 0))
    throw CannotExpress{fmt::format("the HOLZAPFEL energy switches fibres by their strain E, and fibre_switch is '{}'",
                                    switch_words(energy)),
                        ""};
  const std::vector<double> constants = {0.5 * draft.stress * energy.mu, draft.d1(), draft.stress * family.k1,
                                         family.k2, family.A};
  return orientation(energy, false) +
         fmt::format(
             "*MATERIAL, NAME={}\n*ANISOTROPIC HYPERELASTIC, HOLZAPFEL, LOCAL "
             "DIRECTIONS={}\n",
             draft.settings.name, energy.families.size()) +
         data_lines(constants);
}

}  // namespace

std::string hyperelastic_keyword(const Draft& draft, std::size_t most_terms) {
  if (const auto* const energy = std::get_if<PolynomialEnergy>(&draft.material.energy))
    return polynomial_keyword(draft, *energy, most_terms);
  if (const auto* const energy = std::get_if<StretchEnergy>(&draft.material.energy))
    return ogden_keyword(draft, *energy, most_terms);
  throw CannotExpress{"it has no energy with a limit of extension of the chains", "fit 'yeoh' or 'ogden'"};
}

// U = Σ 2 μ_i/α_i² [λ1^α_i + λ2^α_i + λ3^α_i − 3 + (J^(−α_i β_i) − 1)/β_i], the model's own convention
std::string hyperfoam_keyword(const Draft& draft, const FoamEnergy& foam) {
  std::vector<double> values;
  for (const auto& term : foam.terms) values.insert(values.end(), {draft.stress * term.mu, term.alpha});
  for (const auto& term : foam.terms) values.push_back(term.nu);
  return fmt::format("*HYPERFOAM, N={}\n", foam.terms.size()) + data_lines(values);
}

std::string abaqus_card(const Draft& draft) {
  const std::string head = fmt::format("*MATERIAL, NAME={}\n", draft.settings.name);
  if (const auto* const foam = std::get_if<FoamEnergy>(&draft.material.energy))
    return head + hyperfoam_keyword(draft, *foam);
  if (const auto* const fibres = std::get_if<FibreEnergy>(&draft.material.energy))
    return draft.settings.subroutine ? by_subroutine(draft, *fibres) : holzapfel(draft, *fibres);
  return head + hyperelastic_keyword(draft, 6);
}

}  // namespace tunica::cards
