// SPDX-License-Identifier: Apache-2.0
// Holzapfel, Gasser, Ogden (2000), J. Elasticity 61:1–48, doi 10.1023/A:1010835316564:
//
//   W = μ/2 (I1 − 3) + k1/(2 k2) Σ_{i=4,6} [exp(k2 E_i²) − 1],   E_i = I_i − 1.
#include "tunica/models/arterial_fibres.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
enum { mu, k1, k2, theta, parameter_count };

EnergyParts parts(const Options& options) {
  using Fibres = arterial::AlignedFibres<theta>;
  return energy_parts(isotropic::neo_hookean<parameter_count>(mu),
                      arterial::fibres<Fibres, parameter_count>({theta}, {k1, k2}, options));
}

CardEnergy card(const Options& options, std::span<const double> p) {
  return arterial::card_of_pair(p[mu], {p[theta], p[k1], p[k2]}, options);
}

}  // namespace

TUNICA_PLUGIN("hgo", TUNICA_PLUGIN_VERSION) {
  registry.add(with_first_choice(
      with_card(hyperelastic_factory(
                    {.type = "hgo", .parameters = {arterial::mu(), arterial::k1(), arterial::k2(), arterial::theta()}},
                    "Two aligned fibre families in a neo-Hookean matrix (Holzapfel–Gasser–Ogden).",
                    "Holzapfel, Gasser, Ogden, J. Elasticity 61:1 (2000)", parts, {arterial::fibre_switch()}),
                card),
      {{Specimen::tube}}));
}
