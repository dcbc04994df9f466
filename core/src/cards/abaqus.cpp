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
std::string polynomial(const Draft& draft, std::size_t terms) {
  std::vector<double> values;
  for (const char* const name : {"c10", "c01", "c20", "c11", "c02"})
    values.insert(values.end(), draft.material.values.contains(name) ? draft.modulus(name) : 0.0);
  if (terms == 9)
    for (const char* const name : {"c30", "c21", "c12", "c03"}) values.insert(values.end(), draft.modulus(name));
  const std::size_t degree = terms == 9 ? 3 : 2;
  values.insert(values.end(), draft.d1());
  values.resize(values.size() + degree - 1, 0.0);
  return keyword_line(fmt::format("POLYNOMIAL, N={}", degree)) + data_lines(values);
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
std::string by_subroutine(const Draft& draft) {
  const auto& material = draft.material;
  const FibreEnergy energy = fibre_energy(material);
  const double mode = material.fibre_switch == "strain" ? 0 : material.fibre_switch == "stretch" ? 1 : 2;
  std::vector<double> properties = {draft.modulus("mu"), draft.d1(), mode};
  bool normal = false;
  for (const auto& family : energy.families) {
    properties.insert(properties.end(), {draft.stress * family.k1, family.k2, family.A, family.B});
    normal = normal || !family.without_normal();
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
std::string holzapfel(const Draft& draft) {
  const auto& material = draft.material;
  const FibreEnergy energy = fibre_energy(material);
  if (material.type == "four_fibre")
    throw CannotExpress{"the HOLZAPFEL energy has one k1 and one k2 for all families", ""};
  const FibreFamily& family = energy.families.front();
  if (!family.without_normal())
    throw CannotExpress{"the HOLZAPFEL energy lacks the stretch along the normal of the wall", ""};
  if (material.fibre_switch == "none" || (material.fibre_switch == "stretch" && family.A > 0))
    throw CannotExpress{fmt::format("the HOLZAPFEL energy switches fibres by their strain E, and fibre_switch is '{}'",
                                    material.fibre_switch),
                        ""};
  const std::vector<double> constants = {0.5 * draft.modulus("mu"), draft.d1(), draft.stress * family.k1, family.k2,
                                         family.A};
  return orientation(energy, false) +
         fmt::format(
             "*MATERIAL, NAME={}\n*ANISOTROPIC HYPERELASTIC, HOLZAPFEL, LOCAL "
             "DIRECTIONS={}\n",
             draft.settings.name, energy.families.size()) +
         data_lines(constants);
}

}  // namespace

std::string hyperelastic_keyword(const Draft& draft, std::size_t most_ogden_terms) {
  const auto& material = draft.material;
  const double d1 = draft.d1();
  // U = C10 (Ī1 − 3) + (J − 1)²/D1,  C10 = μ/2
  if (material.type == "neo_hooke")
    return keyword_line("NEO HOOKE") + data_lines(std::vector{0.5 * draft.modulus("mu"), d1});
  if (material.type == "mooney_rivlin" && mooney_terms(material) > 2) return polynomial(draft, mooney_terms(material));
  if (material.type == "mooney_rivlin")
    return keyword_line("MOONEY-RIVLIN") + data_lines(std::vector{draft.modulus("c10"), draft.modulus("c01"), d1});
  if (material.type == "yeoh")
    return keyword_line("YEOH") +
           data_lines(std::vector{draft.modulus("c10"), draft.modulus("c20"), draft.modulus("c30"), d1, 0.0, 0.0});
  if (material.type == "ogden") {
    const auto terms = ogden_terms(material);
    if (terms.size() > most_ogden_terms)
      throw CannotExpress{fmt::format("it takes {} terms at most, and these are {}", most_ogden_terms, terms.size()),
                          "fit fewer terms"};
    std::vector<double> values;
    // U = Σ 2 μ_i/α_i² (λ̄1^α_i + λ̄2^α_i + λ̄3^α_i − 3) + Σ (J − 1)^2i/D_i: their μ_i is ½ μ_i α_i here
    for (const auto& term : terms) values.insert(values.end(), {0.5 * draft.stress * term.mu * term.alpha, term.alpha});
    values.insert(values.end(), d1);
    values.resize(3 * terms.size(), 0.0);
    return keyword_line(fmt::format("OGDEN, N={}", terms.size())) + data_lines(values);
  }
  throw CannotExpress{"it has no energy with a limit of extension of the chains", "fit 'yeoh' or 'ogden'"};
}

// U = Σ 2 μ_i/α_i² [λ1^α_i + λ2^α_i + λ3^α_i − 3 + (J^(−α_i β_i) − 1)/β_i], the model's own convention
std::string hyperfoam_keyword(const Draft& draft, std::span<const FoamTerm> terms) {
  std::vector<double> values;
  for (const auto& term : terms) values.insert(values.end(), {draft.stress * term.mu, term.alpha});
  for (const auto& term : terms) values.insert(values.end(), term.nu);
  return fmt::format("*HYPERFOAM, N={}\n", terms.size()) + data_lines(values);
}

std::string abaqus_card(const Draft& draft) {
  if (is_foam(draft.material))
    return fmt::format("*MATERIAL, NAME={}\n{}", draft.settings.name,
                       hyperfoam_keyword(draft, foam_terms(draft.material)));
  if (draft.settings.subroutine) return by_subroutine(draft);
  if (has_fibres(draft.material)) return holzapfel(draft);
  return fmt::format("*MATERIAL, NAME={}\n{}", draft.settings.name, hyperelastic_keyword(draft, 6));
}

}  // namespace tunica::cards
