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
std::string holzapfel_gasser_ogden(const Draft& draft, const FibreEnergy& energy) {
  const FibreFamily& family = energy.families.front();
  return axes + material(draft, "Holzapfel-Gasser-Ogden",
                         element("c", draft.stress * energy.mu) + element("k1", draft.stress * family.k1) +
                             element("k2", family.k2) + element("gamma", 90 - std::abs(family.angle)) +
                             element("kappa", family.A));
}

// ψ = ξ/(α β) (exp(α ⟨I − 1⟩^β) − 1) for every family, β = 2
std::string mixture(const Draft& draft, const FibreEnergy& energy) {
  std::string solids = fmt::format("  <solid type=\"Mooney-Rivlin\">\n  {}  {}  </solid>\n",
                                   element("c1", 0.5 * draft.stress * energy.mu), element("c2", 0));
  for (const auto& family : energy.families) {
    if (family.A > 0)
      throw CannotExpress{"its mixtures have fibres without dispersion only", "fit a pair of families, or A = 0"};
    const double angle = family.angle * std::numbers::pi / 180;
    solids += fmt::format(
        "  <solid type=\"fiber-exp-pow-uncoupled\">\n  {}  {}  {}    <fiber type=\"vector\">{},{},0</fiber>\n  "
        "</solid>\n",
        element("ksi", draft.stress * family.k1), element("alpha", family.k2), element("beta", 2),
        number(std::sin(angle)), number(std::cos(angle)));
  }
  return axes + material(draft, "uncoupled solid mixture", solids);
}

std::string fibres(const Draft& draft, const FibreEnergy& energy) {
  for (const FibreFamily& family : energy.families)
    if (!without_normal(family))
      throw CannotExpress{"its Holzapfel-Gasser-Ogden energy lacks the stretch along the normal of the wall", ""};
  if (energy.active == EnergyPart::Active::always ||
      (energy.active == EnergyPart::Active::fibre_stretched && energy.families.front().A > 0))
    throw CannotExpress{
        fmt::format("it switches fibres by their strain E, and fibre_switch is '{}'", switch_words(energy)),
        "fit with fibre_switch 'strain'"};
  return is_pair(energy) ? holzapfel_gasser_ogden(draft, energy) : mixture(draft, energy);
}

std::string febio_polynomial(const Draft& draft, const PolynomialEnergy& energy) {
  const auto c = [&](const char* name, std::size_t m, std::size_t n) {
    return element(name, draft.stress * coefficient(energy, m, n));
  };
  if (degree(energy) == 1) return material(draft, "Mooney-Rivlin", c("c1", 1, 0) + c("c2", 0, 1));
  if (degree_in_second(energy) > 0)
    throw CannotExpress{"its Mooney-Rivlin energy has two constants", "fit two constants"};
  if (degree(energy) > 3) throw CannotExpress{"its Yeoh energy ends with the third power", "fit fewer constants"};
  return material(draft, "Yeoh", c("c1", 1, 0) + c("c2", 2, 0) + c("c3", 3, 0));
}

// ψ = Σ c_i/m_i² (λ̄1^m_i + λ̄2^m_i + λ̄3^m_i − 3): c_i = μ_i α_i
std::string febio_ogden(const Draft& draft, const StretchEnergy& energy) {
  std::string terms;
  int number_of_term = 0;
  for (const auto& term : energy.terms) {
    ++number_of_term;
    terms += element(fmt::format("c{}", number_of_term), draft.stress * term.mu * term.alpha) +
             element(fmt::format("m{}", number_of_term), term.alpha);
  }
  return material(draft, "Ogden", terms);
}

}  // namespace

std::string febio_card(const Draft& draft) {
  const CardEnergy& energy = draft.material.energy;
  if (const auto* const found = std::get_if<PolynomialEnergy>(&energy)) return febio_polynomial(draft, *found);
  if (const auto* const found = std::get_if<StretchEnergy>(&energy)) return febio_ogden(draft, *found);
  if (const auto* const found = std::get_if<FibreEnergy>(&energy)) return fibres(draft, *found);
  const auto& chains = std::get<LimitedChainEnergy>(energy);  // foams are refused before
  return material(draft, "Gent", element("G", draft.stress * chains.mu) + element("Jm", chains.Jm));
}

}  // namespace tunica::cards
