// SPDX-License-Identifier: Apache-2.0
// Gent (1996), Rubber Chem. Technol. 69:59–61, doi 10.5254/1.3538357:
//
//   W = −(μ Jm/2) ln(1 − (I1 − 3)/Jm),   defined while I1 − 3 < Jm.
#include "tunica/models/isotropic.hpp"
#include "tunica/models/rubber_laws.hpp"
#include "tunica/plugin.hpp"

TUNICA_PLUGIN("gent", TUNICA_PLUGIN_VERSION) {
  using namespace tunica;
  const char* const source = "Gent, Rubber Chem. Technol. 69:59 (1996)";
  ModelFactory gent = isotropic::first_invariant_factory<laws::Gent>(
      {.type = "gent",
       .parameters = {{"mu", "kPa", 300, 0.1, 1e5, Scale::log, "Shear modulus.", source},
                      {"Jm", "1", 100, 0.1, 1e4, Scale::log,
                       "Largest I1 - 3 the chains allow: about 100 for rubber (Gent 1996), 0.4 to 4 for arteries.",
                       "Horgan, Saccomandi, Biomech. Model. Mechanobiol. 1:251 (2003)"}}},
      "Incompressible rubber whose chains have a limit of extension.", source);
  registry.add(with_card(std::move(gent), [](const Options&, std::span<const double> p) {
    return LimitedChainEnergy{p[0], p[1]};
  }));
}
