// SPDX-License-Identifier: Apache-2.0
#include "law_table.hpp"

#include <utility>

#include "tunica/models/convex_laws.hpp"
#include "tunica/models/rubber_laws.hpp"
#include "tunica/models/spline_law.hpp"

namespace tunica::composed {

namespace {

Parameter stiffness(const char* name, const char* doc, const char* source = "") {
  return {name, "kPa", 10, 1e-4, 1e5, Scale::log, doc, source};
}
Parameter rate(const char* name, const char* doc, const char* source = "") {
  return {name, "1", 1, 1e-3, 100, Scale::log, doc, source};
}

const char* const shear = "Shear modulus that the term adds at rest.";

std::vector<Law> closed_laws() {
  using namespace laws;
  const char *const fung = "Fung 1967; Demiray 1972", *const holzapfel = "Holzapfel, Gasser, Ogden 2000",
                    *const chain = "Arruda, Boyce 1993";
  const auto of = [](auto respond) { return Respond(respond); };
  return {
      {"linear", {stiffness("mu", shear)}, of(Linear::respond), false, false, true, "$mu/2 x"},
      {"quadratic",
       {stiffness("k", "Second derivative of the term.")},
       of(Quadratic::respond),
       true,
       true,
       false,
       "$k/2 x^2"},
      {"cubic",
       {stiffness("k", "Half the third derivative of the term.")},
       of(ThirdPower::respond),
       true,
       false,
       false,
       "$k/3 x^3"},
      {"power",
       {stiffness("k", "First derivative of the term at x = 1."), {"m", "1", 3, 2, 20, Scale::linear, "Exponent.", ""}},
       of(Power::respond),
       true,
       false,
       false,
       "$k/$m x^$m"},
      {"exponential",
       {stiffness("mu", shear, fung), rate("b", "How fast the term stiffens.", fung)},
       of(GrowingExponential::respond),
       false,
       false,
       false,
       "$mu/(2 $b) (exp($b x) - 1)"},
      {"exponential_square",
       {stiffness("k1", "Stiffness.", holzapfel), rate("k2", "How fast the term stiffens.", holzapfel)},
       of(Exponential::respond),
       true,
       true,
       false,
       "$k1/(2 $k2) (exp($k2 x^2) - 1)"},
      {"gent",
       {stiffness("mu", shear, "Gent 1996"),
        {"Jm", "1", 50, 0.01, 1e4, Scale::log, "x at which chains reach their full length.", "Gent 1996"}},
       of(Gent::respond),
       false,
       false,
       false,
       "-$mu $Jm/2 ln(1 - x/$Jm)"},
      {"inverse_langevin",
       {stiffness("mu", "Number of chains by k T; close to the shear modulus at rest.", chain),
        {"N", "1", 20, 1.05, 1e4, Scale::log, "Links of a chain, which is straight at x = 3 (N - 1).", chain}},
       of(EightChain::respond),
       false,
       false,
       false,
       "eight chains of $N links, n k T = $mu"},
      {"logarithm",
       {stiffness("mu", shear, "Gent, Thomas 1958")},
       of(Logarithm::respond),
       false,
       false,
       false,
       "3 $mu/2 ln(1 + x/3)"}};
}

/// The curve's parameters enter linearly, so each may be 0.
Law spline(const std::vector<double>& knots, bool has_slope) {
  Law law{"spline", {}, {}, !has_slope, false, false, "a curve over x"};
  const auto height = [](std::string name, double initial, std::string doc) {
    return Parameter{std::move(name), "kPa", initial, 0, 1e5, Scale::linear, std::move(doc), ""};
  };
  if (has_slope) law.parameters.push_back(height("slope", 0, "Slope of the curve at x = 0."));
  for (std::size_t j = 0; j < knots.size(); ++j)
    law.parameters.push_back(height("c_" + std::to_string(j + 1), 10,
                                    "Second derivative of the curve at knot " + std::to_string(j + 1) + "."));
  law.respond = [curve = SplineLaw(knots, has_slope)](std::span<const double> p, const ResponseBatch& batch) {
    curve.respond(p, batch);
  };
  return law;
}

}  // namespace

const std::vector<std::string>& law_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Law& one : closed_laws()) all.push_back(one.name);
    all.emplace_back("spline");
    return all;
  }();
  return names;
}

Law law(const std::string& name, const std::vector<double>& knots, bool isotropic) {
  if (name == "spline") return spline(knots, isotropic);
  for (Law& one : closed_laws())
    if (one.name == name) return std::move(one);
  return {};
}

}  // namespace tunica::composed
