// SPDX-License-Identifier: Apache-2.0
// Gasser, Ogden, Holzapfel (2006), J. R. Soc. Interface 3:15–35, doi 10.1098/rsif.2005.0073:
//
//   W = μ/2 (I1 − 3) + k1/(2 k2) Σ_{i=4,6} [exp(k2 E_i²) − 1],   E_i = κ I1 + (1 − 3κ) I_i − 1.
#include "tunica/models/arterial_fibres.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
enum { mu, kappa, k1, k2, theta, parameter_count };

struct DispersedFibres {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    return {.i1 = p[kappa], .fibre = 1.0 - 3.0 * p[kappa], .offset = T(-1), .angle = p[theta] * degree};
  }
};

EnergyParts parts(const Options& options) {
  return energy_parts(isotropic::neo_hookean<parameter_count>(mu),
                      arterial::fibres<DispersedFibres, parameter_count>({kappa, theta}, {k1, k2}, options));
}

CardEnergy card(const Options& options, std::span<const double> p) {
  return arterial::card_of_pair(p[mu], {p[theta], p[k1], p[k2], p[kappa], 1 - 3 * p[kappa]}, options);
}

}  // namespace

TUNICA_PLUGIN("gho", TUNICA_PLUGIN_VERSION) {
  const Parameter dispersion{"kappa",
                             "1",
                             0.1,
                             0,
                             1. / 3,
                             Scale::linear,
                             "Fibre dispersion: 0 = perfectly aligned, 1/3 = isotropic.",
                             "Gasser, Ogden, Holzapfel 2006, eq. 4.2"};
  registry.add(
      with_card(hyperelastic_factory(
                    {.type = "gho",
                     .parameters = {arterial::mu(), dispersion, arterial::k1(), arterial::k2(), arterial::theta()}},
                    "Two dispersed fibre families in a neo-Hookean matrix (Gasser–Ogden–Holzapfel).",
                    "Gasser, Ogden, Holzapfel, J. R. Soc. Interface 3:15 (2006)", parts, {arterial::fibre_switch()}),
                card));
}
