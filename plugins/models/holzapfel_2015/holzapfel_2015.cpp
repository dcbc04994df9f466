// SPDX-License-Identifier: Apache-2.0
// Holzapfel, Niestrawska, Ogden, Reinisch, Schriefl (2015), J. R. Soc. Interface 12:20150188,
// doi 10.1098/rsif.2015.0188, non-symmetric dispersion:
//
//   W = μ/2 (I1 − 3) + k1/(2 k2) Σ_{i=4,6} [exp(k2 E_i²) − 1],   E_i = A I1 + B I_i + (1 − 3A − B) I_n − 1,
//
// I_n = C_rr in a planar wall. A = κ, B = 1 − 3κ is the `gho`.
#include <cmath>

#include "tunica/models/arterial_fibres.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
enum { mu, A, B, k1, k2, theta, parameter_count };

struct DispersedFibres {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    return {.i1 = p[A], .fibre = p[B], .normal = 1.0 - 3.0 * p[A] - p[B], .offset = T(-1), .angle = p[theta] * degree};
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

EnergyParts parts(const Options& options) {
  return energy_parts(isotropic::neo_hookean<parameter_count>(mu),
                      arterial::fibres<DispersedFibres, parameter_count>({A, B, theta}, {k1, k2}, options));
}

CardEnergy card(const Options& options, std::span<const double> p) {
  return arterial::card_of_pair(p[mu], {p[theta], p[k1], p[k2], p[A], p[B]}, options);
}

ModelDescription description() {
  const char* const source = "Holzapfel, Niestrawska, Ogden, Reinisch, Schriefl 2015, eq. 2.24";
  return {.type = "holzapfel_2015",
          .parameters = {arterial::mu(),
                         {"A", "1", 0.2, 0, 1. / 3, Scale::linear,
                          "Weight of the isotropic invariant I1 (2 κ_op κ_ip).", source},
                         {"B", "1", 0.4, 0, 1, Scale::linear, "Weight of the fibre direction (2 κ_op (1 − 2 κ_ip)).",
                          source},
                         arterial::k1(),
                         arterial::k2(),
                         arterial::theta()},
          .combinations = combinations(),
          .admissible = admissible()};
}

}  // namespace

TUNICA_PLUGIN("holzapfel_2015", TUNICA_PLUGIN_VERSION) {
  registry.add(with_card(
      hyperelastic_factory(description(), "Two fibre families with non-symmetric dispersion in a neo-Hookean matrix.",
                           "Holzapfel et al., J. R. Soc. Interface 12:20150188 (2015)", parts,
                           {arterial::fibre_switch()}),
      card));
}
