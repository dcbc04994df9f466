// SPDX-License-Identifier: Apache-2.0
// Ansys Mechanical APDL, Material Reference, "Hyperelasticity": TB,HYPER. The volumetric term is (J − 1)²/d, that of
// GENT [(J² − 1)/2 − ln J]/d; K = 2/d for both.
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cards/comment.hpp"
#include "cards/writers.hpp"

namespace tunica::cards {

namespace {

/// TBDATA takes six constants.
std::string table(std::size_t points, std::string_view form, const std::vector<double>& constants) {
  std::string lines = fmt::format("TB,HYPER,1,1,{},{}\n", points, form);
  for (std::size_t k = 0; k < constants.size(); ++k) {
    if (k % 6 == 0) lines += fmt::format("{}TBDATA,{}", k == 0 ? "" : "\n", k + 1);
    lines += ',' + number(constants[k]);
  }
  return lines + '\n';
}

// W = Σ C_mn (Ī1 − 3)^m (Ī2 − 3)^n + (J − 1)²/d
std::string ansys_polynomial(const Draft& draft, const PolynomialEnergy& energy) {
  const auto C = [&](std::size_t m, std::size_t n) { return draft.stress * coefficient(energy, m, n); };
  const double d = draft.d1();
  // W = μ/2 (Ī1 − 3) + (J − 1)²/d
  if (consists_of(energy, {{1, 0}})) return table(2, "NEO", {2 * C(1, 0), d});
  if (consists_of(energy, {{1, 0}, {0, 1}})) return table(2, "MOONEY", {C(1, 0), C(0, 1), d});
  if (consists_of(energy, {{1, 0}, {0, 1}, {1, 1}})) return table(3, "MOONEY", {C(1, 0), C(0, 1), C(1, 1), d});
  if (degree(energy) <= 3 && degree_in_second(energy) == 0)
    return table(3, "YEOH", {C(1, 0), C(2, 0), C(3, 0), d, 0, 0});
  if (degree(energy) > 3) throw CannotExpress{"its polynomials end with the third degree", "fit fewer constants"};
  std::vector<double> constants = {C(1, 0), C(0, 1), C(2, 0), C(1, 1), C(0, 2)};
  if (degree(energy) == 3) constants.insert(constants.end(), {C(3, 0), C(2, 1), C(1, 2), C(0, 3)});
  const std::size_t count = constants.size();
  constants.push_back(d);
  return table(count, "MOONEY", constants);
}

// W = Σ μ_i/α_i (λ̄1^α_i + λ̄2^α_i + λ̄3^α_i − 3) + Σ (J − 1)^2k/d_k
std::string ansys_ogden(const Draft& draft, const StretchEnergy& energy) {
  std::vector<double> constants;
  for (const auto& term : energy.terms) constants.insert(constants.end(), {draft.stress * term.mu, term.alpha});
  constants.push_back(draft.d1());
  constants.resize(3 * energy.terms.size(), 0.0);
  return table(energy.terms.size(), "OGDEN", constants);
}

}  // namespace

std::string ansys_card(const Draft& draft) {
  const std::string head = fmt::format("! Material number 1: {}\n", draft.settings.name);
  if (const auto* const energy = std::get_if<PolynomialEnergy>(&draft.material.energy))
    return head + ansys_polynomial(draft, *energy);
  if (const auto* const energy = std::get_if<LimitedChainEnergy>(&draft.material.energy))
    return head + table(3, "GENT", {draft.stress * energy->mu, energy->Jm, draft.d1()});
  if (const auto* const energy = std::get_if<StretchEnergy>(&draft.material.energy))
    return head + ansys_ogden(draft, *energy);
  throw CannotExpress{
      "its anisotropic energies (TB,AHYPER) have no dispersion, and no documented switch for fibres that are "
      "shortened",
      ""};
}

}  // namespace tunica::cards
