// SPDX-License-Identifier: Apache-2.0
// The energy of plugins/models/gho twice more, with nothing derived by hand: as a sum of parts, each a law of one
// invariant, and as one function of several invariants. The cost of this convenience is measured against gho.
#include <cmath>

#include "tunica/models/arterial_fibres.hpp"
#include "tunica/models/joint_energy.hpp"

namespace {

using namespace tunica;
enum { mu, kappa, k1, k2, theta, parameter_count };

std::vector<Parameter> table() {
  return {arterial::mu(),
          {"kappa", "1", 0.1, 0, 1. / 3, Scale::linear, "Fibre dispersion.", ""},
          arterial::k1(),
          arterial::k2(),
          arterial::theta()};
}

/// E = κ I1 + (1 − 3κ) I_4 − 1 of the family at ±theta
template <class T>
InvariantOf<T> strain(std::span<const T> p, double side) {
  return {.i1 = p[kappa], .fibre = 1.0 - 3.0 * p[kappa], .offset = T(-1), .angle = side * p[theta] * degree};
}

struct Matrix {
  static constexpr std::size_t parameter_count = 1;
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    return 0.5 * p[0] * x;
  }
};
struct Exponential {
  static constexpr std::size_t parameter_count = 2;
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    using std::exp;
    return p[0] / (2.0 * p[1]) * (exp(p[1] * x * x) - 1.0);
  }
};
struct Fibres {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    return strain(p, 1);
  }
};

std::unique_ptr<Model> in_parts(const Options&) {
  ModelDescription description;
  description.type = "gho_parts";
  description.parameters = table();
  std::vector<std::unique_ptr<EnergyPart>> parts;
  parts.push_back(isotropic::part<Matrix, isotropic::FirstInvariant, parameter_count>("matrix", {mu}, true));
  parts.push_back(std::make_unique<LawPart<Exponential, Fibres, parameter_count>>(
      EnergyPart::Description{"fibres",
                              EnergyPart::Role::fibre,
                              EnergyPart::Active::argument_positive,
                              true,
                              {kappa, theta},
                              {k1, k2},
                              false}));
  return std::make_unique<Hyperelastic>(std::move(description), std::move(parts));
}

struct Joint {
  static constexpr auto type = "gho_joint", doc = "gho as one function of three invariants.", reference = "";
  static constexpr std::size_t parameter_count = 5, invariant_count = 3;
  static std::vector<Parameter> parameters() { return table(); }
  template <class T>
  static std::array<InvariantOf<T>, 3> invariants(std::span<const T> p) {
    return {{{.i1 = T(1), .offset = T(-3)}, strain(p, 1), strain(p, -1)}};
  }
  template <class T>
  static T energy(std::span<const T> x, std::span<const T> p) {
    T sum = 0.5 * p[mu] * x[0];
    for (const T& strain : {x[1], x[2]})
      if (strain > 0.0) sum += Exponential::energy(strain, p.subspan(k1, 2));
    return sum;
  }
};

}  // namespace

TUNICA_PLUGIN("automatic_gho", "0.1.0") {
  registry.add(ModelFactory{"gho_parts", "gho as a sum of automatic parts.", "", {}, in_parts});
  registry.add(joint_energy<Joint>());
}
