// SPDX-License-Identifier: Apache-2.0
// Gent (1996), Rubber Chem. Technol. 69:59–61, doi 10.5254/1.3538357:
//
//   W = −(μ Jm/2) ln(1 − (I1 − 3)/Jm),   defined while I1 − 3 < Jm.
#include "tunica/models/hyperelastic.hpp"
#include "tunica/models/isotropic.hpp"
#include "tunica/models/rubber_laws.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
enum { mu, Jm, parameter_count };

std::unique_ptr<Model> create(const Options&) {
  ModelDescription description;
  description.type = "gent";
  description.parameters = {
      {"mu", "kPa", 300, 0.1, 1e5, Scale::log, "Shear modulus.", "Gent, Rubber Chem. Technol. 69:59 (1996)"},
      {"Jm", "1", 100, 0.1, 1e4, Scale::log,
       "Largest I1 - 3 the chains allow: about 100 for rubber (Gent 1996), 0.4 to 4 for arteries.",
       "Horgan, Saccomandi, Biomech. Model. Mechanobiol. 1:251 (2003)"}};
  std::vector<std::unique_ptr<EnergyPart>> parts;
  parts.push_back(isotropic::part<laws::Gent, isotropic::FirstInvariant, parameter_count>("matrix", {mu, Jm}));
  return std::make_unique<Hyperelastic>(std::move(description), std::move(parts));
}

}  // namespace

TUNICA_PLUGIN("gent", TUNICA_PLUGIN_VERSION) {
  registry.add(tunica::ModelFactory{"gent",
                                    "Incompressible rubber whose chains have a limit of extension.",
                                    "Gent, Rubber Chem. Technol. 69:59 (1996)",
                                    {},
                                    create});
}
