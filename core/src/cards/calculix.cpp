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
/// CalculiX makes the third component of a direction of the other two, and stops where their squares exceed 1. Twelve
/// digits of a unit vector may; shortened by this factor they cannot, which changes I4 by 1e-11.
constexpr double inside = 1 - 4e-12;

void check_d1(const Draft& draft) {
  if (draft.d1() >= least_d1) return;
  throw InputError(
      fmt::format("units '{}': D1 = 2/K would be {:.3g}, and CalculiX takes what is below {:g} for 0, which "
                  "means Poisson's ratio 0.475; take units with a larger stress, such as mm-N-MPa, or a "
                  "smaller --bulk-ratio",
                  draft.settings.units.name(), draft.d1(), least_d1));
}

// U = C10 (Ī1 − 3) + (J − 1)²/D1 + Σ k1/(2 k2) [exp(k2 ⟨Ī4 − 1⟩²) − 1], up to four families, each with its direction.
std::string elastic_fiber(const Draft& draft) {
  const auto& material = draft.material;
  const FibreEnergy energy = fibre_energy(material);
  if (material.fibre_switch == "none")
    refuse("CalculiX", material, "its fibres carry no load where they are shortened, and fibre_switch is 'none'",
           "fit with fibre_switch 'strain'");
  for (const auto& family : energy.families)
    if (family.A != 0 || !family.without_normal())
      refuse("CalculiX", material, "its fibres have no dispersion (user material ELASTIC_FIBER)",
             "fit 'hgo' or 'four_fibre', or export for FEBio or Abaqus");
  std::vector<double> constants = {0.5 * draft.modulus("mu"), draft.d1()};
  for (const auto& family : energy.families) {
    const double angle = family.angle * std::numbers::pi / 180;
    constants.insert(constants.end(),
                     {inside * std::sin(angle), inside * std::cos(angle), draft.stress * family.k1, family.k2});
  }
  std::string card = comment("**",
                             "Fibres: x is the circumferential direction, y the axial one, of the model or of an "
                             "*ORIENTATION in the *SOLID SECTION.");
  card += fmt::format("*MATERIAL, NAME=ELASTIC_FIBER_{}\n*USER MATERIAL, CONSTANTS={}\n", draft.settings.name,
                      constants.size());
  return card + data_lines(constants);
}

}  // namespace

std::string calculix_card(const Draft& draft) {
  check_d1(draft);
  if (has_fibres(draft.material)) return elastic_fiber(draft);
  const std::string keyword = hyperelastic_keyword(draft, "CalculiX", 3);
  return fmt::format("*MATERIAL, NAME={}\n{}", draft.settings.name, keyword);
}

}  // namespace tunica::cards
