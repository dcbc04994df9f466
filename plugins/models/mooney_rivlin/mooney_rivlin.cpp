// SPDX-License-Identifier: Apache-2.0
// Mooney (1940), J. Appl. Phys. 11:582–592; Rivlin (1948), Phil. Trans. R. Soc. A 241:379–397:
//
//   W = Σ c_mn (I1 − 3)^m (I2 − 3)^n,   shear modulus 2 (c10 + c01).
//
// Two constants: c10, c01. Three: c11 as well. Five: all of m + n ≤ 2. Nine: all of m + n ≤ 3.
#include <memory>
#include <string>
#include <vector>

#include "tunica/models/invariant_polynomial.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

const char* const source = "Rivlin, Phil. Trans. R. Soc. A 241:379 (1948)";

struct Powers {
  std::size_t m, n;
};

/// In the order in which finite-element programs list them.
std::vector<Powers> powers_of(std::size_t terms) {
  if (terms == 3) return {{1, 0}, {0, 1}, {1, 1}};
  const std::vector<Powers> all{{1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}};
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(terms)};
}

/// With two constants both are at least 0, and the energy is convex. With more, any of them may be negative in a sound
/// material.
Parameter constant(const Powers& at, std::size_t terms) {
  const std::string m = std::to_string(at.m), n = std::to_string(at.n);
  const double least = terms == 2 ? 0 : -1e4;
  if (at.m + at.n > 1)
    return {"c" + m + n, "kPa", 0, least, 1e4, Scale::linear, "Weight of (I1 - 3)^" + m + " (I2 - 3)^" + n + ".",
            source};
  if (at.m == 1)
    return {"c10", "kPa", 150, least, 1e4, Scale::linear, "Weight of I1; half the shear modulus is c10 + c01.", source};
  return {"c01", "kPa", 15, least, 1e4, Scale::linear, "Weight of I2.", source};
}

std::unique_ptr<Model> create(const Options& options) {
  const std::size_t terms = options.count("terms");
  if (terms != 2 && terms != 3 && terms != 5 && terms != 9)
    throw InputError("mooney_rivlin: \"terms\" is " + std::to_string(terms) +
                     ", and the polynomials in use have 2, 3, 5 or 9 constants; give one of these");
  ModelDescription description{.type = "mooney_rivlin"};
  std::vector<isotropic::PolynomialTerm> all;
  for (const Powers& at : powers_of(terms)) {
    all.push_back({at.m, at.n, description.parameters.size()});
    description.parameters.push_back(constant(at, terms));
  }
  return std::make_unique<Hyperelastic>(std::move(description), isotropic::polynomial_parts(all));
}

CardEnergy card(const Options& options, std::span<const double> constants) {
  PolynomialEnergy energy;
  for (const Powers& at : powers_of(options.count("terms")))
    energy.terms.push_back({at.m, at.n, constants[energy.terms.size()]});
  return energy;
}

}  // namespace

TUNICA_PLUGIN("mooney_rivlin", TUNICA_PLUGIN_VERSION) {
  registry.add(ModelFactory{"mooney_rivlin",
                            "Incompressible rubber, a polynomial in the invariants I1 and I2 (Mooney–Rivlin).",
                            "Mooney, J. Appl. Phys. 11:582 (1940)",
                            {Option::integer("terms", 2, {2, 9}, "Number of constants: 2, 3, 5 or 9.")},
                            create,
                            card});
}
