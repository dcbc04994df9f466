// SPDX-License-Identifier: Apache-2.0
// Foams, whose lateral strain is small and whose volume changes as much as their length (Ogden 1972; Hill 1978;
// Storåkers, J. Mech. Phys. Solids 34:125, 1986):
//
//   W = Σ_i 2μ_i/α_i² [λ1^α_i + λ2^α_i + λ3^α_i − 3 + (J^(−α_i β_i) − 1)/β_i],   β = ν/(1 − 2ν).
//
// Shear modulus Σ μ_i, bulk modulus Σ 2 μ_i (1/3 + β_i). Blatz and Ko (Trans. Soc. Rheol. 6:223, 1962) is two terms
// with α = 2 and −2, weights f and 1 − f, and one ν; their foam has f = 0, ν = 1/4: W = μ/2 (I2/I3 + 2 √I3 − 5).
#include <memory>
#include <utility>

#include "foam.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
using foam::Term;
constexpr std::size_t most_terms = 3;
constexpr const char *storakers = "Storakers, J. Mech. Phys. Solids 34:125 (1986)",
                     *blatz_ko = "Blatz, Ko, Trans. Soc. Rheol. 6:223 (1962)";

Parameter poisson(const std::string& name, const std::string& doc, const char* source) {
  return {name, "1", 0.2, -0.45, 0.49, Scale::linear, doc, source};
}

template <std::size_t terms>
std::unique_ptr<Model> hyperfoam(bool shared) {
  ModelDescription description;
  description.type = "hyperfoam";
  constexpr std::array<double, most_terms> first_alpha{8, -2, 2};
  for (std::size_t k = 0; k < terms; ++k) {
    const std::string number = std::to_string(k + 1);
    description.parameters.push_back({"mu_" + number, "kPa", k == 0 ? 20.0 : 5.0, k == 0 ? 1e-3 : -5000, 1e5,
                                      k == 0 ? Scale::log : Scale::linear,
                                      "Part of the shear modulus in term " + number + ".", storakers});
    description.parameters.push_back({"alpha_" + number, "1", first_alpha[k], -30, 30, Scale::linear,
                                      "Exponent of term " + number + "; not 0.", storakers});
    if (!shared)
      description.parameters.push_back(poisson("nu_" + number, "Poisson's ratio of term " + number + ".", storakers));
  }
  if (shared) description.parameters.push_back(poisson("nu", "Poisson's ratio of all terms.", storakers));
  return std::make_unique<foam::Foam<terms>>(std::move(description), [shared](std::span<const double> p) {
    std::array<Term, terms> of;
    for (std::size_t k = 0; k < terms; ++k) {
      const std::size_t first = (shared ? 2 : 3) * k;
      of[k] = {p[first], p[first + 1], shared ? p.back() : p[first + 2],
               first,    first + 1,    shared ? p.size() - 1 : first + 2};
    }
    return of;
  });
}

std::unique_ptr<Model> create_hyperfoam(const Options& options) {
  static constexpr std::array makers{hyperfoam<1>, hyperfoam<2>, hyperfoam<3>};
  return makers.at(options.count("terms") - 1)(options.text("poisson") == "shared");
}

std::unique_ptr<Model> create_blatz_ko(const Options&) {
  ModelDescription description;
  description.type = "blatz_ko";
  description.parameters = {{"mu", "kPa", 200, 1e-3, 1e6, Scale::log, "Shear modulus.", blatz_ko},
                            {"f", "1", 0.1, 0, 1, Scale::linear, "Weight of I1 beside I2/I3; 0 for a foam.", blatz_ko},
                            poisson("nu", "Poisson's ratio.", blatz_ko)};
  // μ_1 = μ f, μ_2 = μ (1 − f).
  return std::make_unique<foam::Foam<2>>(std::move(description), [](std::span<const double> p) {
    return std::array<Term, 2>{
        Term{p[0] * p[1], 2, p[2], Term::none, Term::none, 2, {{{0, p[1]}, {1, p[0]}}}},
        Term{p[0] * (1 - p[1]), -2, p[2], Term::none, Term::none, 2, {{{0, 1 - p[1]}, {1, -p[0]}}}}};
  });
}

CardEnergy hyperfoam_card(const Options& options, std::span<const double> p) {
  const bool shared = options.text("poisson") == "shared";
  FoamEnergy energy;
  for (std::size_t k = 0; k + 2 < p.size() + (shared ? 1 : 0); k += shared ? 2 : 3)
    energy.terms.push_back({p[k], p[k + 1], shared ? p.back() : p[k + 2]});
  return energy;
}

/// A term of weight 0 is left out.
CardEnergy blatz_ko_card(const Options&, std::span<const double> p) {
  const double mu = p[0], f = p[1], nu = p[2];
  FoamEnergy energy;
  if (f != 0) energy.terms.push_back({mu * f, 2, nu});
  if (f != 1) energy.terms.push_back({mu * (1 - f), -2, nu});
  return energy;
}

}  // namespace

TUNICA_PLUGIN("hyperfoam", TUNICA_PLUGIN_VERSION) {
  registry.add(ModelFactory{
      "hyperfoam",
      "Compressible foam, powers of the principal stretches (Ogden-Hill).",
      storakers,
      {Option::integer("terms", 1, {1, most_terms}, "Number of terms; each has its own mu and alpha."),
       Option::choice("poisson", {"shared", "each"}, "shared", "One Poisson's ratio for all terms, or one for each.")},
      create_hyperfoam,
      hyperfoam_card});
  registry.add(ModelFactory{"blatz_ko",
                            "Compressible foam rubber: W of I1, I2/I3 and J with one Poisson's ratio.",
                            blatz_ko,
                            {},
                            create_blatz_ko,
                            blatz_ko_card});
}
