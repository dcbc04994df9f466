// SPDX-License-Identifier: Apache-2.0
// Holzapfel, Niestrawska, Ogden, Reinisch, Schriefl (2015), J. R. Soc. Interface 12:20150188,
// doi 10.1098/rsif.2015.0188, non-symmetric dispersion:
//
//   W = μ/2 (I1 − 3) + k1/(2 k2) Σ_{i=4,6} [exp(k2 E_i²) − 1],   E_i = A I1 + B I_i + (1 − 3A − B) I_n − 1,
//
// I_n = C_rr in a planar wall. A = κ, B = 1 − 3κ is the `gho`.
#include "tunica/models/arterial_fibres.hpp"

namespace {

using namespace tunica;
enum { mu, A, B, k1, k2, theta, parameter_count };

struct Fibres {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    InvariantOf<T> e;
    e.i1 = p[A];
    e.fibre = p[B];
    e.normal = 1.0 - 3.0 * p[A] - p[B];
    e.offset = T(-1);
    e.angle = p[theta] * degree;
    return e;
  }
};

/// In aligned tests λ_r² = 1/(λ_t² λ_z²) closes E as a function of 2A + B and B cos 2θ alone: the mean of the two
/// in-plane coefficients and half their difference.
std::vector<Combination> combinations() {
  const std::string remedy = "a strip cut off the axes, for example at 45 deg, with its shear measured";
  return {{"2A + B", "1", {A, B}, [](std::span<const double> p) { return 2 * p[A] + p[B]; }, remedy},
          {"B cos 2theta",
           "1",
           {B, theta},
           [](std::span<const double> p) { return p[B] * std::cos(2 * p[theta] * degree); },
           remedy}};
}

/// The generalised structure tensor has no negative weight (Holzapfel et al. 2015, §2.3): along the family A + B,
/// across it in the plane A, along the normal 1 − 2A − B.
std::vector<Combination> admissible() {
  return {{"A + B", "1", {A, B}, [](std::span<const double> p) { return p[A] + p[B]; }, ""},
          {"1 - 2A - B", "1", {A, B}, [](std::span<const double> p) { return 1 - 2 * p[A] - p[B]; }, ""}};
}

std::unique_ptr<Model> create(const Options& options) {
  const std::string source = "Holzapfel, Niestrawska, Ogden, Reinisch, Schriefl 2015, eq. 2.24";
  ModelDescription description;
  description.type = "holzapfel_2015";
  description.parameters = {
      arterial::mu(),
      {"A", "1", 0.2, 0, 1. / 3, Scale::linear, "Weight of the isotropic invariant I1 (2 κ_op κ_ip).", source},
      {"B", "1", 0.4, 0, 1, Scale::linear, "Weight of the fibre direction (2 κ_op (1 − 2 κ_ip)).", source},
      arterial::k1(),
      arterial::k2(),
      arterial::theta()};
  description.combinations = combinations();
  description.admissible = admissible();
  std::vector<std::unique_ptr<EnergyPart>> parts;
  parts.push_back(isotropic::neo_hookean<parameter_count>(mu));
  parts.push_back(arterial::fibres<Fibres, parameter_count>({A, B, theta}, {k1, k2}, options));
  return std::make_unique<Hyperelastic>(std::move(description), std::move(parts));
}

}  // namespace

TUNICA_PLUGIN("holzapfel_2015", TUNICA_PLUGIN_VERSION) {
  registry.add(tunica::ModelFactory{"holzapfel_2015",
                                    "Two fibre families with non-symmetric dispersion in a neo-Hookean matrix.",
                                    "Holzapfel et al., J. R. Soc. Interface 12:20150188 (2015)",
                                    {tunica::arterial::fibre_switch()},
                                    create});
}
