// SPDX-License-Identifier: Apache-2.0
// Holzapfel, Weizsäcker (1998), Comput. Biol. Med. 28:377–392, doi 10.1016/S0010-4825(98)00022-5: a neo-Hookean
// matrix, and an exponential of Fung's type in the Green–Lagrange strains of the wall,
//
//   W = μ/2 (I1 − 3) + c/2 (e^Q − 1),   Q = a_t E_t² + a_z E_z² + 2 a_tz E_t E_z.
#include <numbers>

#include "tunica/models/joint_energy.hpp"

using namespace tunica;

struct Fung {
  static constexpr auto type = "fung_exponential", doc = "Arterial wall with an exponential of Fung's type.",
                        reference = "Holzapfel, Weizsäcker, Comput. Biol. Med. 28:377 (1998)";
  enum { mu, c, a_t, a_z, a_tz, parameter_count };
  static constexpr std::size_t invariant_count = 3;

  static std::vector<Parameter> parameters() {
    return {{"mu", "kPa", 10, 0.1, 200, Scale::log, "Shear modulus of the matrix.", reference},
            {"c", "kPa", 20, 0.1, 1000, Scale::log, "Stiffness of the exponential.", reference},
            {"a_t", "1", 1, 0.01, 20, Scale::log, "Circumferential exponent.", reference},
            {"a_z", "1", 1, 0.01, 20, Scale::log, "Axial exponent.", reference},
            {"a_tz", "1", 0.1, -5, 20, Scale::linear, "Coupling of both directions.", reference}};
  }
  /// Q is positive definite: a_t a_z ≥ a_tz².
  static std::vector<Combination> admissible() {
    return {
        {"a_t a_z - a_tz^2", "1", {a_t, a_z, a_tz}, [](auto p) { return p[a_t] * p[a_z] - p[a_tz] * p[a_tz]; }, ""}};
  }
  /// I1 − 3, E_t = (C_tt − 1)/2 and E_z = (C_zz − 1)/2: directions are angles from the axis, in radians.
  template <class T>
  static std::array<InvariantOf<T>, 3> invariants(std::span<const T>) {
    return {{{.i1 = T(1), .offset = T(-3)},
             {.fibre = T(0.5), .offset = T(-0.5), .angle = T(std::numbers::pi / 2)},
             {.fibre = T(0.5), .offset = T(-0.5)}}};
  }
  template <class T>
  static T energy(std::span<const T> x, std::span<const T> p) {
    using std::exp;
    const T Q = p[a_t] * x[1] * x[1] + p[a_z] * x[2] * x[2] + 2.0 * p[a_tz] * x[1] * x[2];
    return 0.5 * p[mu] * x[0] + 0.5 * p[c] * (exp(Q) - 1.0);
  }
};

TUNICA_PLUGIN("fung_exponential", "1.0.0") { registry.add(joint_energy<Fung>()); }
