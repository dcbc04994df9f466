// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "tunica/models/laws.hpp"

/// Convex responses beyond those of named models: the laws that `composed` adds to laws.hpp and rubber_laws.hpp, whose
/// rules they follow. With stiffnesses ≥ 0 each is convex where it is used.
namespace tunica::laws {

/// A law at one x.
template <std::size_t parameters>
struct Point {
  double value = 0;                  ///< ψ, kPa
  double first = 0;                  ///< dψ/dx, kPa
  double second = 0;                 ///< d²ψ/dx², kPa
  double value_dp[parameters] = {};  ///< ∂ψ/∂p_j
  double first_dp[parameters] = {};  ///< ∂(dψ/dx)/∂p_j
};

/// Writes the outputs that are wanted, point by point; `law(x)` returns a Point.
template <std::size_t parameters, class Law>
void respond_pointwise(const ResponseBatch& b, const Law& law) {
  const std::size_t n = b.x.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point<parameters> at = law(b.x[i]);
    if (!b.value.empty()) b.value[i] = at.value;
    if (!b.first.empty()) b.first[i] = at.first;
    if (!b.second.empty()) b.second[i] = at.second;
    for (std::size_t j = 0; j < parameters; ++j) {
      if (!b.value_dp.empty()) b.value_dp[j * n + i] = at.value_dp[j];
      if (!b.first_dp.empty()) b.first_dp[j * n + i] = at.first_dp[j];
    }
  }
}

/// ψ = (k/2) x².
struct Quadratic {
  static constexpr std::size_t parameter_count = 1;  ///< k, kPa

  /// ψ for any scalar type.
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    return 0.5 * p[0] * x * x;
  }
  /// Derivatives by hand.
  static void respond(std::span<const double> p, const ResponseBatch& b) {
    respond_pointwise<1>(b, [k = p[0]](double x) -> Point<1> {
      return {0.5 * k * x * x, k * x, k, {0.5 * x * x}, {x}};
    });
  }
};

/// ψ = (k/3) x³, convex for x ≥ 0.
struct ThirdPower {
  static constexpr std::size_t parameter_count = 1;  ///< k, kPa

  /// ψ for any scalar type.
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    return p[0] / 3.0 * x * x * x;
  }
  /// Derivatives by hand.
  static void respond(std::span<const double> p, const ResponseBatch& b) {
    respond_pointwise<1>(b, [k = p[0]](double x) -> Point<1> {
      return {k / 3 * x * x * x, k * x * x, 2 * k * x, {x * x * x / 3}, {x * x}};
    });
  }
};

/// ψ = (k/m) x^m for x > 0, and 0 below; m ≥ 2 keeps ψ'' finite at rest.
struct Power {
  static constexpr std::size_t parameter_count = 2;  ///< k in kPa, m

  /// ψ for any scalar type.
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    using std::exp, std::log;
    return x > T(0.0) ? p[0] / p[1] * exp(p[1] * log(x)) : T(0.0);
  }
  /// Derivatives by hand.
  static void respond(std::span<const double> p, const ResponseBatch& b) {
    respond_pointwise<2>(b, [k = p[0], m = p[1]](double x) -> Point<2> {
      if (!(x > 0)) return {0, 0, m == 2 ? k : 0};
      const double l = std::log(x), slope = std::exp((m - 1) * l), whole = slope * x / m;
      // ∂ψ/∂m = ψ (ln x − 1/m)
      return {k * whole, k * slope, k * (m - 1) * slope / x, {whole, k * whole * (l - 1 / m)}, {slope, k * slope * l}};
    });
  }
};

/// ψ = μ/(2b) [exp(b x) − 1] with its limit (μ/2) x at b = 0 (Fung 1967; Demiray 1972, with x = I1 − 3).
struct GrowingExponential {
  static constexpr std::size_t parameter_count = 2;  ///< μ in kPa, b

  /// ψ for any scalar type; 0/0 at b = 0, where respond() has the limit.
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    using std::exp;
    return p[0] / (2.0 * p[1]) * (exp(p[1] * x) - 1.0);
  }
  /// Derivatives by hand.
  static void respond(std::span<const double> p, const ResponseBatch& b) {
    respond_pointwise<2>(b, [mu = p[0], rate = p[1]](double x) -> Point<2> {
      const double y = rate * x, e = std::exp(y);
      // ψ = μ/2 x φ(bx),  ∂ψ/∂b = μ/2 x² φ'(bx),  ψ' = μ/2 e^{bx}
      const double whole = 0.5 * x * Exponential::phi(y);
      return {mu * whole,
              0.5 * mu * e,
              0.5 * mu * rate * e,
              {whole, 0.5 * mu * x * x * Exponential::phi_prime(y)},
              {0.5 * e, 0.5 * mu * x * e}};
    });
  }
};

/// ψ = (3μ/2) ln(1 + x/3): with x = I2 − 3 the second term of Gent and Thomas (1958), ln(I2/3). It is concave in x, and
/// the energy convex in the stretches for all that.
struct Logarithm {
  static constexpr std::size_t parameter_count = 1;  ///< μ, kPa

  /// ψ for any scalar type; not a number for x ≤ −3.
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    using std::log;
    return 1.5 * p[0] * log(1.0 + x / 3.0);
  }
  /// Derivatives by hand.
  static void respond(std::span<const double> p, const ResponseBatch& b) {
    respond_pointwise<1>(b, [mu = p[0]](double x) -> Point<1> {
      const double q = 1 / (3 + x), logarithm = 1.5 * std::log1p(x / 3);
      return {mu * logarithm, 1.5 * mu * q, -1.5 * mu * q * q, {logarithm}, {1.5 * q}};
    });
  }
};

/// L(β) = coth β − 1/β, the mean extension of a freely jointed chain, and its slope. The series about 0 keeps the
/// digits that the difference would lose.
struct Langevin {
  double value;  ///< L(β)
  double slope;  ///< dL/dβ

  /// At β ≥ 0.
  explicit Langevin(double beta) {
    const double b = beta * beta;
    if (b < 0.04) {
      value = beta * (1. / 3 - b * (1. / 45 - b * (2. / 945 - b * (1. / 4725 - b * (2. / 93555 - b * 2.1644e-6)))));
      slope = 1. / 3 - b * (1. / 15 - b * (2. / 189 - b * (1. / 675 - b * (2. / 10395 - b * 2.38084e-5))));
    } else {
      const double s = std::sinh(std::min(beta, 300.0));
      value = 1 / std::tanh(beta) - 1 / beta;
      slope = 1 / b - 1 / (s * s);
    }
  }
};

/// β with L(β) = y on [0, 1) to rounding: Newton's method from Jedynak's quotient (2015, Rheol. Acta 54:29), which is
/// within 2 %. Infinite from y = 1 on.
inline double inverse_langevin(double y) {
  if (!(y < 1)) return std::numeric_limits<double>::infinity();
  double beta = y * (3 - 2.6 * y + 0.7 * y * y) / ((1 - y) * (1 + 0.1 * y));
  for (int step = 0; step < 8; ++step) {
    const Langevin at(beta);
    const double next = beta - (at.value - y) / at.slope;
    const bool found = std::abs(next - beta) <= 1e-14 * beta;
    beta = next;
    if (found) break;
  }
  return beta;
}

/// Eight chains of N links along the diagonals of a cube, x = I1 − 3 (Arruda, Boyce 1993), with the inverse Langevin
/// function itself, not its series:
///
///     ψ = μ N [y β + ln(β/sinh β)] less its value at rest,  L(β) = y = √((x + 3)/(3N)).
///
/// μ = n k T; the shear modulus at rest is μ β√N/3 with L(β) = 1/√N, a little more. From x = 3(N − 1) on, where the
/// chains are straight, every number is infinite.
struct EightChain {
  static constexpr std::size_t parameter_count = 2;  ///< μ in kPa, N

  /// Derivatives by hand.
  static void respond(std::span<const double> p, const ResponseBatch& b) {
    const double mu = p[0], links = p[1];
    // y β + ln(β/sinh β), without overflow; the series about 0 keeps the digits that logarithms would lose
    const auto energy = [](double y, double beta) {
      const double b = beta * beta;
      if (beta < 0.1) return y * beta - b * (1. / 6 - b * (1. / 180 - b * (1. / 2835 - b / 37800)));
      return y * beta + std::log(2 * beta) - beta - std::log1p(-std::exp(-2 * beta));
    };
    const double y0 = 1 / std::sqrt(links), beta0 = inverse_langevin(y0), rest = energy(y0, beta0);
    respond_pointwise<2>(b, [=](double x) -> Point<2> {
      constexpr double beyond = std::numeric_limits<double>::infinity();
      const double y = std::sqrt((x + 3) / (3 * links)), beta = inverse_langevin(y);
      if (!(y < 1)) return {beyond, beyond, beyond, {beyond, beyond}, {beyond, beyond}};
      const double grown = energy(y, beta) - rest, bend = 1 / Langevin(beta).slope - beta / y;
      // ψ' = μ β/(6y),  dy/dx = 1/(6Ny),  dy/dN = −y/(2N)
      return {mu * links * grown,
              mu * beta / (6 * y),
              mu * bend / (36 * links * y * y),
              {links * grown, mu * (grown - 0.5 * (y * beta - y0 * beta0))},
              {beta / (6 * y), -mu * bend / (12 * links)}};
    });
  }
};

}  // namespace tunica::laws
