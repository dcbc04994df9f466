// SPDX-License-Identifier: Apache-2.0
// Treloar (1943), Trans. Faraday Soc. 39:241–246: W = μ/2 (I1 − 3).
#include "tunica/models/hyperelastic.hpp"
#include "tunica/models/isotropic.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

std::unique_ptr<Model> create(const Options&) {
  ModelDescription description;
  description.type = "neo_hooke";
  description.parameters = {
      {"mu", "kPa", 100, 0.1, 1e5, Scale::log, "Shear modulus.", "Treloar, Trans. Faraday Soc. 39:241 (1943)"}};
  std::vector<std::unique_ptr<EnergyPart>> parts;
  parts.push_back(isotropic::neo_hookean<1>(0));
  return std::make_unique<Hyperelastic>(std::move(description), std::move(parts));
}

}  // namespace

TUNICA_PLUGIN("neo_hooke", TUNICA_PLUGIN_VERSION) {
  registry.add(tunica::ModelFactory{"neo_hooke",
                                    "Incompressible rubber with Gaussian chains: one modulus.",
                                    "Treloar, Trans. Faraday Soc. 39:241 (1943)",
                                    {},
                                    create});
}
