// SPDX-License-Identifier: Apache-2.0
// LS-DYNA Keyword User's Manual, volume II: *MAT_HYPERELASTIC_RUBBER (077_H), *MAT_OGDEN_RUBBER (077_O), N = 0: the
// constants are given. The bulk modulus follows from Poisson's ratio.
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cards/writers.hpp"
#include "tunica/error.hpp"

namespace tunica::cards {

namespace {

/// As many digits as ten columns hold: at least five.
std::string field(double value) {
  for (int digits = 10; digits > 1; --digits) {
    std::string text = fmt::format("{:.{}g}", value, digits);
    for (const char* const zero : {"e-0", "e+0"})  // 1e-05 is 1e-5
      if (const auto at = text.find(zero); at != std::string::npos) text.erase(at + 2, 1);
    if (text.size() <= 10) return fmt::format("{:>10}", text);
  }
  return fmt::format("{:>10.2e}", value);
}

std::string line(std::span<const double> values) {
  std::string fields;
  for (const double value : values) fields += field(value);
  return fields + '\n';
}

/// The title, then MID, RO, PR, N = 0 and no viscosity.
std::string head(const Draft& draft, std::string_view keyword) {
  const std::string density = draft.density();
  if (density.empty())
    throw InputError(
        "a card of LS-DYNA has a density, and a calibration knows none; give it, for example --density \"1000 kg/m3\"");
  const double shear = draft.stress * stiffness_at_rest(draft.material), bulk = draft.bulk;
  // ν = (3K − 2G)/(6K + 2G)
  const double poisson = (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear);
  const double written = std::stod(field(poisson)), read = 2 * shear * (1 + written) / (3 * (1 - 2 * written));
  if (!(std::abs(read / bulk - 1) < 0.01))
    throw InputError(
        fmt::format("bulk ratio: found {:g}, and LS-DYNA reads Poisson's ratio from ten columns, which lose it; take "
                    "1e5 or less",
                    bulk / shear));
  return fmt::format("*MAT_{}_TITLE\n{}\n$      mid        ro        pr         n\n{:>10}{}{}{:>10}\n", keyword,
                     draft.settings.name, 1, field(*draft.settings.density * draft.settings.units.density_per_kg_m3),
                     field(poisson), 0);
}

// W = Σ C_pq (Ī1 − 3)^p (Ī2 − 3)^q + W_H(J)
std::string lsdyna_polynomial(const Draft& draft, const PolynomialEnergy& energy) {
  const auto C = [&](std::size_t p, std::size_t q) { return draft.stress * coefficient(energy, p, q); };
  if (degree(energy) > 3) throw CannotExpress{"*MAT_HYPERELASTIC_RUBBER ends with c30", "fit 5 constants"};
  if (degree(energy) == 3 && degree_in_second(energy) > 0)
    throw CannotExpress{"*MAT_HYPERELASTIC_RUBBER has no c21, c12 and c03", "fit 5 constants"};
  return head(draft, "HYPERELASTIC_RUBBER") + "$      c10       c01       c11       c20       c02       c30\n" +
         line(std::array{C(1, 0), C(0, 1), C(1, 1), C(2, 0), C(0, 2), C(3, 0)});
}

// W = Σ μ_j/α_j (λ̄1^α_j + λ̄2^α_j + λ̄3^α_j − 3)
std::string lsdyna_ogden(const Draft& draft, const StretchEnergy& energy) {
  std::vector<double> mu, alpha;
  for (const auto& term : energy.terms) {
    mu.push_back(draft.stress * term.mu);
    alpha.push_back(term.alpha);
  }
  return head(draft, "OGDEN_RUBBER") + "$ mu of the terms, then alpha\n" + line(mu) + line(alpha);
}

}  // namespace

std::string lsdyna_card(const Draft& draft) {
  if (const auto* const energy = std::get_if<PolynomialEnergy>(&draft.material.energy))
    return lsdyna_polynomial(draft, *energy);
  if (const auto* const energy = std::get_if<StretchEnergy>(&draft.material.energy))
    return lsdyna_ogden(draft, *energy);
  if (has_fibres(draft.material))
    throw CannotExpress{"tunica writes no card of its anisotropic energies (*MAT_295)", ""};
  throw CannotExpress{"it has no energy with a limit of extension of the chains", "fit 'yeoh' or 'ogden'"};
}

}  // namespace tunica::cards
