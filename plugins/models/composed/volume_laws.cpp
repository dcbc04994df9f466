// SPDX-License-Identifier: Apache-2.0
// Energies U(J) of the volume ratio, as functions of x = J − 1. Collected in Doll, Schweizerhof, J. Appl. Mech. 67:17
// (2000). K is the bulk modulus that the term adds at rest; only a power above 2 adds none.
#include "volume_laws.hpp"

#include <cmath>

#include "tunica/models/convex_laws.hpp"

namespace tunica::composed {
namespace {

using laws::Point;
using laws::respond_pointwise;

/// U = K/2 ln²J,  U' = K ln J/J,  U'' = K (1 − ln J)/J²
void logarithmic(std::span<const double> p, const ResponseBatch& b) {
  respond_pointwise<1>(b, [K = p[0]](double x) -> Point<1> {
    const double J = 1 + x, theta = std::log1p(x), whole = 0.5 * theta * theta;
    return {K * whole, K * theta / J, K * (1 - theta) / (J * J), {whole}, {theta / J}};
  });
}

/// U = K/4 (J² − 1 − 2 ln J),  U' = K/2 (J − 1/J),  U'' = K/2 (1 + 1/J²)
void simo(std::span<const double> p, const ResponseBatch& b) {
  respond_pointwise<1>(b, [K = p[0]](double x) -> Point<1> {
    const double J = 1 + x, whole = 0.25 * (x * (2 + x) - 2 * std::log1p(x)), slope = 0.5 * x * (2 + x) / J;
    return {K * whole, K * slope, 0.5 * K * (1 + 1 / (J * J)), {whole}, {slope}};
  });
}

/// U = K/m |x|^m
void power(std::span<const double> p, const ResponseBatch& b) {
  respond_pointwise<2>(b, [K = p[0], m = p[1]](double x) -> Point<2> {
    const double size = std::abs(x);
    if (size == 0) return {0, 0, m == 2 ? K : 0, {0, 0}, {0, 0}};
    const double l = std::log(size), steep = std::exp((m - 2) * l), slope = steep * x, whole = slope * x / m;
    // ∂U/∂m = U (ln |x| − 1/m)
    return {K * whole, K * slope, K * (m - 1) * steep, {whole, K * whole * (l - 1 / m)}, {slope, K * slope * l}};
  });
}

/// h(y) = (e^−y − 1 + y)/y² and h'(y) = −(e^−y (2 + y) − 2 + y)/y³, series about 0.
double h(double y) {
  if (std::abs(y) > 1e-2) return (std::expm1(-y) + y) / (y * y);
  return 1. / 2 - y * (1. / 6 - y * (1. / 24 - y * (1. / 120 - y * (1. / 720 - y / 5040))));
}
double h_prime(double y) {
  if (std::abs(y) > 0.1) return -(std::exp(-y) * (2 + y) - 2 + y) / (y * y * y);
  return -1. / 6 + y * (1. / 12 - y * (1. / 40 - y * (1. / 180 - y * (1. / 1008 - y * (1. / 6720 - y / 51840)))));
}

/// U = K/β² (β ln J + J^−β − 1) = K θ² h(βθ) with θ = ln J; K/2 θ² at β = 0. With φ(y) = (e^y − 1)/y,
///
///   J U' = K θ φ(−βθ),   J² U'' = K e^−βθ − J U',   ∂U/∂β = K θ³ h'(βθ),   J ∂U'/∂β = −K θ² φ'(−βθ).
void ogden(std::span<const double> p, const ResponseBatch& b) {
  respond_pointwise<2>(b, [K = p[0], beta = p[1]](double x) -> Point<2> {
    const double J = 1 + x, theta = std::log1p(x), y = beta * theta;
    const double whole = theta * theta * h(y), slope = theta * laws::Exponential::phi(-y);
    return {K * whole,
            K * slope / J,
            K * (std::exp(-y) - slope) / (J * J),
            {whole, K * theta * theta * theta * h_prime(y)},
            {slope / J, -K * theta * theta * laws::Exponential::phi_prime(-y) / J}};
  });
}

Law law_of(const std::string& name, std::vector<Parameter> parameters, Respond respond, const std::string& formula) {
  return {name, std::move(parameters), std::move(respond), true, true, false, formula};
}

std::vector<Law> all_laws() {
  const Parameter K{"K", "kPa", 100, 1e-4, 1e6, Scale::log, "Bulk modulus that the term adds at rest.", ""};
  const Parameter k1{"k1", "kPa", 100, 1e-4, 1e6, Scale::log, "Bulk modulus that the term adds at rest.", ""};
  const Parameter k2{"k2", "1", 1, 1e-3, 100, Scale::log, "How fast the term stiffens.", ""};
  const Parameter m{"m", "1", 4, 2, 20, Scale::linear, "Exponent.", ""};
  Parameter of_power = K;
  of_power.doc = "Weight of the term; the bulk modulus at rest where m is 2.";
  const Parameter beta{
      "beta", "1", 9, -30, 30, Scale::linear, "Exponent; above 0 the term is steep in compression.", "Ogden 1972"};
  return {law_of("quadratic", {K}, laws::Quadratic::respond, "$K/2 x^2"),
          law_of("power", {of_power, m}, power, "$K/$m |x|^$m"),
          law_of("exponential_square", {k1, k2}, laws::Exponential::respond, "$k1/(2 $k2) (exp($k2 x^2) - 1)"),
          law_of("logarithmic", {K}, logarithmic, "$K/2 (ln J)^2"),
          law_of("simo", {K}, simo, "$K/4 (J^2 - 1 - 2 ln J)"),
          law_of("ogden", {K, beta}, ogden, "$K/$beta^2 ($beta ln J + J^-$beta - 1)")};
}

}  // namespace

const std::vector<std::string>& volume_law_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Law& one : all_laws()) all.push_back(one.name);
    return all;
  }();
  return names;
}

Law volume_law(const std::string& name) {
  for (Law& one : all_laws())
    if (one.name == name) return std::move(one);
  return {};
}

}  // namespace tunica::composed
