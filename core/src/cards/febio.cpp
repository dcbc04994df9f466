// SPDX-License-Identifier: Apache-2.0
// FEBio User's Manual, uncoupled materials: Mooney-Rivlin, Yeoh, Gent, Ogden, Holzapfel-Gasser-Ogden, and the uncoupled
// solid mixture with fiber-exp-pow-uncoupled. All add k/2 (ln J)².
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "cards/comment.hpp"
#include "cards/writers.hpp"

namespace tunica::cards {

namespace {

std::string element(std::string_view name, double value) {
  return fmt::format("  <{0}>{1}</{0}>\n", name, number(value));
}

std::string material(const Draft& draft, std::string_view type, const std::string& elements) {
  const std::string density = draft.density();
  return fmt::format("<material id=\"1\" name=\"{}\" type=\"{}\">\n", draft.settings.name, type) +
         (density.empty() ? "" : fmt::format("  <density>{}</density>\n", density)) + elements +
         element("k", draft.bulk) + "</material>\n";
}

const char* const axes =
    "<!-- Fibres: the first material axis is the circumferential direction, the second the axial "
    "one. -->\n";

// ψ = c/2 (Ī1 − 3) + k1/(2 k2) Σ (exp(k2 ⟨E⟩²) − 1), the families at ±gamma from the first material axis
std::string holzapfel_gasser_ogden(const Draft& draft, const FibreFamily& family) {
  return axes + material(draft, "Holzapfel-Gasser-Ogden",
                         element("c", draft.modulus("mu")) + element("k1", draft.stress * family.k1) +
                             element("k2", family.k2) + element("gamma", 90 - std::abs(family.angle)) +
                             element("kappa", family.A));
}

// ψ = ξ/(α β) (exp(α ⟨I − 1⟩^β) − 1) for every family, β = 2
std::string mixture(const Draft& draft, const FibreEnergy& energy) {
  std::string solids = fmt::format("  <solid type=\"Mooney-Rivlin\">\n  {}  {}  </solid>\n",
                                   element("c1", 0.5 * draft.modulus("mu")), element("c2", 0));
  for (const auto& family : energy.families) {
    const double angle = family.angle * std::numbers::pi / 180;
    solids += fmt::format(
        "  <solid type=\"fiber-exp-pow-uncoupled\">\n  {}  {}  {}    <fiber type=\"vector\">{},{},0</fiber>\n  "
        "</solid>\n",
        element("ksi", draft.stress * family.k1), element("alpha", family.k2), element("beta", 2),
        number(std::sin(angle)), number(std::cos(angle)));
  }
  return axes + material(draft, "uncoupled solid mixture", solids);
}

std::string fibres(const Draft& draft) {
  const auto& energy = fibre_energy(draft.material);
  const FibreFamily& family = energy.families.front();
  const std::string& chosen = draft.material.fibre_switch;
  if (!family.without_normal())
    throw CannotExpress{"its Holzapfel-Gasser-Ogden energy lacks the stretch along the normal of the wall", ""};
  if (chosen == "none" || (chosen == "stretch" && family.A > 0))
    throw CannotExpress{fmt::format("it switches fibres by their strain E, and fibre_switch is '{}'", chosen),
                        "fit with fibre_switch 'strain'"};
  return draft.material.type == "four_fibre" ? mixture(draft, energy) : holzapfel_gasser_ogden(draft, family);
}

}  // namespace

std::string febio_card(const Draft& draft) {
  const std::string& type = draft.material.type;
  if (has_fibres(draft.material)) return fibres(draft);
  if (type == "neo_hooke")
    return material(draft, "Mooney-Rivlin", element("c1", 0.5 * draft.modulus("mu")) + element("c2", 0));
  if (type == "mooney_rivlin" && mooney_terms(draft.material) > 2)
    throw CannotExpress{"its Mooney-Rivlin energy has two constants", "fit two constants"};
  if (type == "mooney_rivlin")
    return material(draft, "Mooney-Rivlin", element("c1", draft.modulus("c10")) + element("c2", draft.modulus("c01")));
  if (type == "yeoh")
    return material(draft, "Yeoh",
                    element("c1", draft.modulus("c10")) + element("c2", draft.modulus("c20")) +
                        element("c3", draft.modulus("c30")));
  if (type == "gent")
    return material(draft, "Gent", element("G", draft.modulus("mu")) + element("Jm", value_of(draft.material, "Jm")));
  // ψ = Σ c_i/m_i² (λ̄1^m_i + λ̄2^m_i + λ̄3^m_i − 3): c_i = μ_i α_i
  std::string terms;
  int number_of_term = 0;
  for (const auto& term : ogden_terms(draft.material)) {
    ++number_of_term;
    terms += element(fmt::format("c{}", number_of_term), draft.stress * term.mu * term.alpha) +
             element(fmt::format("m{}", number_of_term), term.alpha);
  }
  return material(draft, "Ogden", terms);
}

}  // namespace tunica::cards
