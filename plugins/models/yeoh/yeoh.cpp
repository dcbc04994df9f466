// SPDX-License-Identifier: Apache-2.0
// Yeoh (1993), Rubber Chem. Technol. 66:754–771, doi 10.5254/1.3538343:
//
//   W = c10 (I1 − 3) + c20 (I1 − 3)² + c30 (I1 − 3)³,   shear modulus 2 c10.
#include "tunica/models/hyperelastic.hpp"
#include "tunica/models/isotropic.hpp"
#include "tunica/models/rubber_laws.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
enum { c10, c20, c30, parameter_count };

std::unique_ptr<Model> create(const Options&) {
  const std::string source = "Yeoh, Rubber Chem. Technol. 66:754 (1993)";
  ModelDescription description;
  description.type = "yeoh";
  description.parameters = {
      {"c10", "kPa", 150, 0.05, 1e5, Scale::log, "Half the shear modulus.", source},
      {"c20", "kPa", 0, -1e3, 1e3, Scale::linear, "Second coefficient: negative where rubber first softens.", source},
      {"c30", "kPa", 0.1, -100, 100, Scale::linear, "Third coefficient: the stiffening at large stretch.", source}};
  std::vector<std::unique_ptr<EnergyPart>> parts;
  parts.push_back(isotropic::part<laws::Cubic, isotropic::FirstInvariant, parameter_count>("matrix", {c10, c20, c30}));
  return std::make_unique<Hyperelastic>(std::move(description), std::move(parts));
}

}  // namespace

TUNICA_PLUGIN("yeoh", TUNICA_PLUGIN_VERSION) {
  registry.add(tunica::ModelFactory{"yeoh",
                                    "Incompressible rubber, a cubic polynomial in I1 − 3.",
                                    "Yeoh, Rubber Chem. Technol. 66:754 (1993)",
                                    {},
                                    create});
}
