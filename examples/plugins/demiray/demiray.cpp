// SPDX-License-Identifier: Apache-2.0
// Demiray (1972), J. Biomech. 5:309–311, doi 10.1016/0021-9290(72)90047-4: soft tissue without a direction,
//
//   W = a/(2b) (e^{b (I1 − 3)} − 1),   shear modulus a.
#include "tunica/models/isotropic.hpp"
#include "tunica/plugin.hpp"

using namespace tunica;

/// The energy as a function of its invariant x = I1 − 3; every derivative follows from it.
struct DemirayLaw {
  static constexpr std::size_t parameter_count = 2;
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    using std::exp;
    return p[0] / (2.0 * p[1]) * (exp(p[1] * x) - 1.0);
  }
};

TUNICA_PLUGIN("demiray", "1.0.0") {
  const char* const source = "Demiray, J. Biomech. 5:309 (1972)";
  registry.add(isotropic::first_invariant_factory<DemirayLaw>(
      {.type = "demiray",
       .parameters = {{"a", "kPa", 10, 0.1, 1000, Scale::log, "Shear modulus.", source},
                      {"b", "1", 1, 0.01, 50, Scale::log, "How fast the tissue stiffens.", source}}},
      "Soft tissue without a direction, an exponential of I1.", source));
}
