// SPDX-License-Identifier: Apache-2.0
// Treloar (1943), Trans. Faraday Soc. 39:241–246: W = μ/2 (I1 − 3).
#include "tunica/models/isotropic.hpp"
#include "tunica/plugin.hpp"

TUNICA_PLUGIN("neo_hooke", TUNICA_PLUGIN_VERSION) {
  using namespace tunica;
  const char* const source = "Treloar, Trans. Faraday Soc. 39:241 (1943)";
  ModelFactory neo_hooke = hyperelastic_factory(
      {.type = "neo_hooke", .parameters = {{"mu", "kPa", 100, 0.1, 1e5, Scale::log, "Shear modulus.", source}}},
      "Incompressible rubber with Gaussian chains: one modulus.", source,
      [](const Options&) { return energy_parts(isotropic::neo_hookean<1>(0)); });
  registry.add(with_card(std::move(neo_hooke), [](const Options&, std::span<const double> p) {
    return PolynomialEnergy{{{1, 0, 0.5 * p[0]}}};
  }));
}
