// SPDX-License-Identifier: Apache-2.0
// Ansys Mechanical APDL, Material Reference, "Hyperelasticity": TB,HYPER. The volumetric term is (J − 1)²/d, that of
// GENT [(J² − 1)/2 − ln J]/d; K = 2/d for both.
#include <array>
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

}  // namespace

std::string ansys_card(const Draft& draft) {
  const auto& material = draft.material;
  const double d = draft.d1();
  if (has_fibres(material))
    throw CannotExpress{
        "its anisotropic energies (TB,AHYPER) have no dispersion, and no documented switch for fibres that are "
        "shortened",
        ""};
  const std::string head = fmt::format("! Material number 1: {}\n", draft.settings.name);
  // W = μ/2 (Ī1 − 3) + (J − 1)²/d
  if (material.type == "neo_hooke") return head + table(2, "NEO", {draft.modulus("mu"), d});
  // W = Σ C_mn (Ī1 − 3)^m (Ī2 − 3)^n + (J − 1)²/d
  if (material.type == "mooney_rivlin") {
    const std::size_t terms = mooney_terms(material);
    std::vector<double> constants = {draft.modulus("c10"), draft.modulus("c01")};
    if (terms == 3) constants.insert(constants.end(), draft.modulus("c11"));
    if (terms >= 5)
      for (const char* const name : {"c20", "c11", "c02"}) constants.insert(constants.end(), draft.modulus(name));
    if (terms == 9)
      for (const char* const name : {"c30", "c21", "c12", "c03"})
        constants.insert(constants.end(), draft.modulus(name));
    constants.insert(constants.end(), d);
    return head + table(terms, "MOONEY", constants);
  }
  if (material.type == "yeoh")
    return head + table(3, "YEOH", {draft.modulus("c10"), draft.modulus("c20"), draft.modulus("c30"), d, 0, 0});
  if (material.type == "gent") return head + table(3, "GENT", {draft.modulus("mu"), value_of(material, "Jm"), d});
  // W = Σ μ_i/α_i (λ̄1^α_i + λ̄2^α_i + λ̄3^α_i − 3) + Σ (J − 1)^2k/d_k
  const auto terms = ogden_terms(material);
  std::vector<double> constants;
  for (const auto& term : terms) constants.insert(constants.end(), {draft.stress * term.mu, term.alpha});
  constants.insert(constants.end(), d);
  constants.resize(3 * terms.size(), 0.0);
  return head + table(terms.size(), "OGDEN", constants);
}

}  // namespace tunica::cards
