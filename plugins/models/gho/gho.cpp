// SPDX-License-Identifier: Apache-2.0
// Gasser, Ogden, Holzapfel (2006), J. R. Soc. Interface 3:15–35, doi 10.1098/rsif.2005.0073:
//
//   W = μ/2 (I1 − 3) + k1/(2 k2) Σ_{i=4,6} [exp(k2 E_i²) − 1],   E_i = κ I1 + (1 − 3κ) I_i − 1.
#include "tunica/models/arterial_fibres.hpp"

namespace {

using namespace tunica;
enum { mu, kappa, k1, k2, theta, parameter_count };

struct Fibres {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    InvariantOf<T> e;
    e.i1 = p[kappa];
    e.fibre = 1.0 - 3.0 * p[kappa];
    e.offset = T(-1);
    e.angle = p[theta] * degree;
    return e;
  }
};

std::unique_ptr<Model> create(const Options& options) {
  ModelDescription description;
  description.type = "gho";
  description.parameters = {
      arterial::mu(),
      {"kappa", "1", 0.1, 0, 1. / 3, Scale::linear, "Fibre dispersion: 0 = perfectly aligned, 1/3 = isotropic.",
       "Gasser, Ogden, Holzapfel 2006, eq. 4.2"},
      arterial::k1(),
      arterial::k2(),
      arterial::theta()};
  std::vector<std::unique_ptr<EnergyPart>> parts;
  parts.push_back(isotropic::neo_hookean<parameter_count>(mu));
  parts.push_back(arterial::fibres<Fibres, parameter_count>({kappa, theta}, {k1, k2}, options));
  return std::make_unique<Hyperelastic>(std::move(description), std::move(parts));
}

}  // namespace

TUNICA_PLUGIN("gho", TUNICA_PLUGIN_VERSION) {
  registry.add(tunica::ModelFactory{"gho",
                                    "Two dispersed fibre families in a neo-Hookean matrix (Gasser–Ogden–Holzapfel).",
                                    "Gasser, Ogden, Holzapfel, J. R. Soc. Interface 3:15 (2006)",
                                    {tunica::arterial::fibre_switch()},
                                    create});
}
