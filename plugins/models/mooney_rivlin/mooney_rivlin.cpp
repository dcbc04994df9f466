// SPDX-License-Identifier: Apache-2.0
// Mooney (1940), J. Appl. Phys. 11:582–592; Rivlin (1948), Phil. Trans. R. Soc. A 241:379–397:
//
//   W = c10 (I1 − 3) + c01 (I2 − 3),   shear modulus 2 (c10 + c01).
#include "tunica/models/hyperelastic.hpp"
#include "tunica/models/isotropic.hpp"
#include "tunica/models/rubber_laws.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
enum { c10, c01, parameter_count };

std::unique_ptr<Model> create(const Options&) {
  const std::string source = "Rivlin, Phil. Trans. R. Soc. A 241:379 (1948)";
  ModelDescription description;
  description.type = "mooney_rivlin";
  description.parameters = {
      {"c10", "kPa", 150, 0, 1e4, Scale::linear, "Weight of I1; half the shear modulus is c10 + c01.", source},
      {"c01", "kPa", 15, 0, 1e4, Scale::linear, "Weight of I2.", source}};
  std::vector<std::unique_ptr<EnergyPart>> parts;
  parts.push_back(
      isotropic::part<laws::Proportional, isotropic::FirstInvariant, parameter_count>("matrix", {c10}, true));
  parts.push_back(isotropic::part<laws::Proportional, isotropic::SecondInvariant, parameter_count>("second_invariant",
                                                                                                   {c01}, true));
  return std::make_unique<Hyperelastic>(std::move(description), std::move(parts));
}

}  // namespace

TUNICA_PLUGIN("mooney_rivlin", TUNICA_PLUGIN_VERSION) {
  registry.add(tunica::ModelFactory{"mooney_rivlin",
                                    "Incompressible rubber, linear in the invariants I1 and I2 (Mooney–Rivlin).",
                                    "Mooney, J. Appl. Phys. 11:582 (1940)",
                                    {},
                                    create});
}
