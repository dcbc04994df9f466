// SPDX-License-Identifier: Apache-2.0
// Ogden (1972), Proc. R. Soc. A 326:565–584, doi 10.1098/rspa.1972.0026, in his own convention:
//
//   W = Σ_i (μ_i/α_i) (λ1^α_i + λ2^α_i + λ3^α_i − 3),   shear modulus ½ Σ_i μ_i α_i.
//
// Finite-element codes often write 2 μ_i/α_i² instead of μ_i/α_i; their μ_i is ½ μ_i α_i here.
#include "tunica/models/principal_stretches.hpp"
#include "tunica/models/rubber_laws.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
constexpr std::size_t most_terms = 6;

/// Ogden's own three terms for Treloar's rubber, then small ones between and beyond.
constexpr std::array<double, most_terms> first_mu{630, 1.2, -10, 1, -1, 1}, first_alpha{1.3, 5, -2, 3, -4, 8};

template <std::size_t terms>
std::unique_ptr<Model> create() {
  const std::string source = "Ogden, Proc. R. Soc. A 326:565 (1972)";
  ModelDescription description;
  description.type = "ogden";
  for (std::size_t k = 0; k < terms; ++k) {
    const std::string number = std::to_string(k + 1);
    description.parameters.push_back({"mu_" + number, "kPa", first_mu[k], -5000, 5000, Scale::linear,
                                      "Coefficient of term " + number + "; mu alpha > 0 stiffens.", source});
    description.parameters.push_back(
        {"alpha_" + number, "1", first_alpha[k], -30, 30, Scale::linear, "Exponent of term " + number + ".", source});
  }
  return std::make_unique<PrincipalStretches<laws::Ogden<terms>>>(std::move(description));
}

std::unique_ptr<Model> create_with(const Options& options) {
  static constexpr std::array makers{create<1>, create<2>, create<3>, create<4>, create<5>, create<6>};
  return makers.at(options.count("terms") - 1)();
}

CardEnergy card(const Options&, std::span<const double> p) {
  StretchEnergy energy;
  for (std::size_t k = 0; k < p.size(); k += 2) energy.terms.push_back({p[k], p[k + 1]});
  return energy;
}

}  // namespace

TUNICA_PLUGIN("ogden", TUNICA_PLUGIN_VERSION) {
  // One term leaves 4 to 17 times the misfit of two on strips of porcine dermis.
  const FirstChoice choice{{Specimen::other, Specimen::strip, Specimen::sheet, Specimen::block},
                           {{"terms", std::int64_t{2}}}};
  registry.add(with_first_choice(
      ModelFactory{
          "ogden",
          "Incompressible rubber, powers of the principal stretches: W = sum of mu/alpha (sum of lambda^alpha - 3).",
          "Ogden, Proc. R. Soc. A 326:565 (1972)",
          {Option::integer("terms", 3, {1, most_terms}, "Number of terms; each has its own mu and alpha.")},
          create_with,
          card},
      choice));
}
