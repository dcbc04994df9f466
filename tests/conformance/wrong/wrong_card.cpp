// SPDX-License-Identifier: Apache-2.0
// The card takes a shear modulus for its coefficient.
#include "right.hpp"

TUNICA_PLUGIN("wrong_card", "0.1.0") {
  using namespace tunica;
  registry.add(with_card(wrong::factory<wrong::Right>("wrong_card", "Rubber with the card of another."),
                         [](const Options&, std::span<const double> c) {
                           return PolynomialEnergy{{{1, 0, 2 * c[0]}, {2, 0, c[1]}, {3, 0, c[2]}}};
                         }));
}
