// SPDX-License-Identifier: Apache-2.0
// Holzapfel, Gasser, Ogden (2000), J. Elasticity 61:1–48, doi 10.1023/A:1010835316564:
//
//   W = μ/2 (I1 − 3) + k1/(2 k2) Σ_{i=4,6} [exp(k2 E_i²) − 1],   E_i = I_i − 1.
#include "tunica/models/arterial_fibres.hpp"

namespace {

using namespace tunica;
enum { mu, k1, k2, theta, parameter_count };

struct Fibres {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    InvariantOf<T> e;
    e.fibre = T(1);
    e.offset = T(-1);
    e.angle = p[theta] * degree;
    return e;
  }
};

std::unique_ptr<Model> create(const Options& options) {
  ModelDescription description;
  description.type = "hgo";
  description.parameters = {arterial::mu(), arterial::k1(), arterial::k2(), arterial::theta()};
  std::vector<std::unique_ptr<EnergyPart>> parts;
  parts.push_back(isotropic::neo_hookean<parameter_count>(mu));
  parts.push_back(arterial::fibres<Fibres, parameter_count>({theta}, {k1, k2}, options));
  return std::make_unique<Hyperelastic>(std::move(description), std::move(parts));
}

}  // namespace

TUNICA_PLUGIN("hgo", TUNICA_PLUGIN_VERSION) {
  registry.add(tunica::ModelFactory{"hgo",
                                    "Two aligned fibre families in a neo-Hookean matrix (Holzapfel–Gasser–Ogden).",
                                    "Holzapfel, Gasser, Ogden, J. Elasticity 61:1 (2000)",
                                    {tunica::arterial::fibre_switch()},
                                    create});
}
