// SPDX-License-Identifier: Apache-2.0
// Arruda, Boyce (1993), J. Mech. Phys. Solids 41:389–412, doi 10.1016/0022-5096(93)90013-6: eight chains of N links
// along the diagonals of a cube, with the inverse Langevin function itself instead of its series,
//
//   W = μ N [y β + ln(β/sinh β)] less its value at rest,   L(β) = coth β − 1/β = y = √(I1/(3N)),   defined while y < 1.
#include "tunica/models/convex_laws.hpp"
#include "tunica/models/isotropic.hpp"
#include "tunica/plugin.hpp"

TUNICA_PLUGIN("arruda_boyce", TUNICA_PLUGIN_VERSION) {
  using namespace tunica;
  const char* const source = "Arruda, Boyce, J. Mech. Phys. Solids 41:389 (1993)";
  registry.add(isotropic::first_invariant_factory<laws::EightChain>(
      {.type = "arruda_boyce",
       .parameters = {{"mu", "kPa", 270, 0.1, 1e5, Scale::log,
                       "Number of chains per volume times k T; the shear modulus at rest is a little larger.", source},
                      {"N", "1", 26.5, 1.05, 1e4, Scale::log,
                       "Links of a chain; chains are at full length at I1 - 3 = 3 (N - 1).", source}}},
      "Incompressible rubber, eight chains with the inverse Langevin function.", source));
}
