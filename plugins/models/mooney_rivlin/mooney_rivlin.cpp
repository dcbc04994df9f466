// SPDX-License-Identifier: Apache-2.0
// Mooney (1940), J. Appl. Phys. 11:582–592; Rivlin (1948), Phil. Trans. R. Soc. A 241:379–397:
//
//   W = c10 (I1 − 3) + c01 (I2 − 3),   shear modulus 2 (c10 + c01).
#include "tunica/models/isotropic.hpp"
#include "tunica/models/rubber_laws.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
enum { c10, c01, parameter_count };

EnergyParts parts(const Options&) {
  using isotropic::FirstInvariant, isotropic::SecondInvariant;
  return energy_parts(
      isotropic::part<laws::Proportional, FirstInvariant, parameter_count>("matrix", {c10}, true),
      isotropic::part<laws::Proportional, SecondInvariant, parameter_count>("second_invariant", {c01}, true));
}

}  // namespace

TUNICA_PLUGIN("mooney_rivlin", TUNICA_PLUGIN_VERSION) {
  const char* const source = "Rivlin, Phil. Trans. R. Soc. A 241:379 (1948)";
  registry.add(
      hyperelastic_factory({.type = "mooney_rivlin",
                            .parameters = {{"c10", "kPa", 150, 0, 1e4, Scale::linear,
                                            "Weight of I1; half the shear modulus is c10 + c01.", source},
                                           {"c01", "kPa", 15, 0, 1e4, Scale::linear, "Weight of I2.", source}}},
                           "Incompressible rubber, linear in the invariants I1 and I2 (Mooney–Rivlin).",
                           "Mooney, J. Appl. Phys. 11:582 (1940)", parts));
}
