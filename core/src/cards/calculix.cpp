// SPDX-License-Identifier: Apache-2.0
// CalculiX CrunchiX User's Manual: *HYPERELASTIC, and "Fiber reinforced materials" (user material ELASTIC_FIBER).
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cards/comment.hpp"
#include "cards/writers.hpp"
#include "tunica/error.hpp"

namespace tunica::cards {

namespace {

/// CalculiX takes a D1 below this for zero, and then Poisson's ratio 0.475 (CalculiX 2.20, seen in all its energies).
constexpr double least_d1 = 1e-10;
/// A component of a direction with fifteen digits, towards zero. CalculiX makes the third component of the other two,
/// and stops where their squares exceed 1, which rounding may do. This tilts the direction by less than 1e-7.
std::string component(double value) {
  constexpr double digits = 1e15;
  return fmt::format("{:.15f}", std::trunc((1 - 2e-15) * value * digits) / digits);
}

void check_d1(const Draft& draft) {
  if (draft.d1() >= least_d1) return;
  throw InputError(
      fmt::format("units '{}': D1 = 2/K would be {:.3g}, and CalculiX takes what is below {:g} for 0, which "
                  "means Poisson's ratio 0.475; take units with a larger stress, such as mm-N-MPa, or a "
                  "smaller --bulk-ratio",
                  draft.settings.units.name(), draft.d1(), least_d1));
}

// U = C10 (Ī1 − 3) + (J − 1)²/D1 + Σ k1/(2 k2) [exp(k2 ⟨Ī4 − 1⟩²) − 1], up to four families, each with its direction.
std::string elastic_fiber(const Draft& draft, const FibreEnergy& energy) {
  const bool unswitched = energy.active == EnergyPart::Active::always;
  if (energy.families.size() > 4) throw CannotExpress{"it has four families of fibres at most", ""};
  const std::string with_strain = unswitched ? " with fibre_switch 'strain'" : "";
  for (const auto& family : energy.families)
    if (family.A != 0 || !without_normal(family))
      throw CannotExpress{"its fibres have no dispersion (user material ELASTIC_FIBER)",
                          fmt::format("fit 'hgo' or 'four_fibre'{}", with_strain)};
  if (unswitched)
    throw CannotExpress{"its fibres carry no load where they are shortened, and fibre_switch is 'none'",
                        "fit" + with_strain};
  std::vector<std::string> constants = {number(0.5 * draft.stress * energy.mu), number(draft.d1())};
  for (const auto& family : energy.families) {
    const double angle = family.angle * std::numbers::pi / 180;
    constants.insert(constants.end(), {component(std::sin(angle)), component(std::cos(angle)),
                                       number(draft.stress * family.k1), number(family.k2)});
  }
  std::string card = comment("**",
                             "Fibres: x is the circumferential direction, y the axial one, of the model or of an "
                             "*ORIENTATION in the *SOLID SECTION.");
  card += fmt::format("*MATERIAL, NAME=ELASTIC_FIBER_{}\n*USER MATERIAL, CONSTANTS={}\n", draft.settings.name,
                      constants.size());
  return card + joined_lines(constants);
}

/// CalculiX 2.20 breaks off with N=1: a single term is written as two halves.
FoamEnergy halved(FoamEnergy foam) {
  if (foam.terms.size() > 1) return foam;
  foam.terms.front().mu /= 2;
  foam.terms.push_back(foam.terms.front());
  return foam;
}

}  // namespace

std::string calculix_card(const Draft& draft) {
  const std::string head = fmt::format("*MATERIAL, NAME={}\n", draft.settings.name);
  if (const auto* const foam = std::get_if<FoamEnergy>(&draft.material.energy))
    return head + hyperfoam_keyword(draft, halved(*foam));
  check_d1(draft);
  if (const auto* const fibres = std::get_if<FibreEnergy>(&draft.material.energy)) return elastic_fiber(draft, *fibres);
  return head + hyperelastic_keyword(draft, 3);
}

}  // namespace tunica::cards
