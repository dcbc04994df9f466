// SPDX-License-Identifier: Apache-2.0
// Yeoh (1993), Rubber Chem. Technol. 66:754–771, doi 10.5254/1.3538343:
//
//   W = c10 (I1 − 3) + c20 (I1 − 3)² + c30 (I1 − 3)³,   shear modulus 2 c10.
#include "tunica/models/isotropic.hpp"
#include "tunica/models/rubber_laws.hpp"
#include "tunica/plugin.hpp"

TUNICA_PLUGIN("yeoh", TUNICA_PLUGIN_VERSION) {
  using namespace tunica;
  const char* const source = "Yeoh, Rubber Chem. Technol. 66:754 (1993)";
  ModelFactory yeoh = isotropic::first_invariant_factory<laws::Cubic>(
      {.type = "yeoh",
       .parameters = {{"c10", "kPa", 150, 0.05, 1e5, Scale::log, "Half the shear modulus.", source},
                      {"c20", "kPa", 0, -1e3, 1e3, Scale::linear,
                       "Second coefficient: negative where rubber first softens.", source},
                      {"c30", "kPa", 0.1, -100, 100, Scale::linear,
                       "Third coefficient: the stiffening at large stretch.", source}}},
      "Incompressible rubber, a cubic polynomial in I1 − 3.", source);
  registry.add(with_card(std::move(yeoh), [](const Options&, std::span<const double> c) {
    return PolynomialEnergy{{{1, 0, c[0]}, {2, 0, c[1]}, {3, 0, c[2]}}};
  }));
}
