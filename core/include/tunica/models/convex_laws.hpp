// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "tunica/detail/vector_level.hpp"
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
/// the energy is nevertheless convex in the stretches.
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

/// Freely jointed chains over lanes: β with L(β) = y, L(β) = coth β − 1/β the mean extension, and what comes with it.
struct Chains {
  using Row = std::array<double, 64>;  ///< a number for each of up to 64 points
  Chains() {}                          // leaves the rows as they are: entries that are read were written
  alignas(64) Row y;                   ///< extension, set by the caller
  alignas(64) Row beta;                ///< meaningless where not y < 1
  alignas(64) Row slope;               ///< dL/dβ
  alignas(64) Row grown;               ///< y β + ln(β/sinh β)

  /// Newton's method from Jedynak's quotient (2015, Rheol. Acta 54:29), which is within 2 %: five steps leave rounding.
  void solve(std::size_t n, bool energy) {
    constexpr int steps = 5;
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) {
      y[i] = y[i] < 1 ? y[i] : 0.5;
      beta[i] = y[i] * (3 - 2.6 * y[i] + 0.7 * y[i] * y[i]) / ((1 - y[i]) * (1 + 0.1 * y[i]));
    }
    for (int step = 0; step < steps; ++step) {
      TUNICA_LANES
      for (std::size_t i = 0; i < n; ++i) {
        const Langevin at(beta[i]);
        beta[i] -= (at.value - y[i]) / at.slope;
      }
    }
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) slope[i] = Langevin(beta[i]).slope;
    if (!energy) return;
    // ln(sinh β/β), without overflow
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) {
      const double b = beta[i] * beta[i], left = 1 - detail::lane_exp(-2 * beta[i]);
      const double log_near = b * series(b, [](double order) { return 1 / (2 * order); });
      const double log_far = beta[i] - detail::lane_log(2 * beta[i] / left);
      grown[i] = y[i] * beta[i] - (b < near ? log_near : log_far);
    }
  }

 private:
  /// 2^2n B_2n/(2n)!, n = 1, 2, …: L(β) = Σ c_n β^(2n−1), and ln(sinh β/β) = Σ c_n β^2n/(2n). Where b = β² is smaller
  /// than `near` they leave rounding, and the closed forms lose digits.
  static constexpr std::array<double, 14> c{0.3333333333333333,      -0.022222222222222223,   0.0021164021164021165,
                                            -0.00021164021164021165, 2.1377799155576935e-05,  -2.1644042808063972e-06,
                                            2.1925947851873778e-07,  -2.2214608789979678e-08, 2.2507846516808994e-09,
                                            -2.2805151204592183e-10, 2.3106432599002624e-11,  -2.3411706819824882e-12,
                                            2.3721017400233653e-13,  -2.4034415333307705e-14};
  static constexpr double near = 0.5;
  /// Σ factor(n) c_n (β²)^(n−1)
  template <class Factor>
  [[gnu::always_inline]] static double series(double square, const Factor& factor) {
    double sum = 0;
    for (std::size_t k = c.size(); k-- > 0;) sum = sum * square + factor(static_cast<double>(k + 1)) * c[k];
    return sum;
  }

  /// L and its slope at β ≥ 0.
  struct Langevin {
    double value, slope;

    [[gnu::always_inline]] explicit Langevin(double beta) {
      const double b = beta * beta, e = detail::lane_exp(-2 * beta), left = 1 - e;
      const double value_near = beta * series(b, [](double) { return 1.0; });
      const double slope_near = series(b, [](double order) { return 2 * order - 1; });
      // coth β = (1 + e)/(1 − e),  1/sinh² β = 4 e/(1 − e)²,  e = exp(−2β)
      value = b < near ? value_near : (1 + e) / left - 1 / beta;
      slope = b < near ? slope_near : 1 / b - 4 * e / (left * left);
    }
  };
};

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
    constexpr double beyond = std::numeric_limits<double>::infinity();
    const double mu = p[0], links = p[1];
    const std::size_t n = b.x.size();
    const bool energy = !b.value.empty() || !b.value_dp.empty();
    Chains chains;
    double y0 = 0, beta0 = 0, rest = 0;
    if (energy) {  // as a whole vector, so that W vanishes at rest to the last bit
      std::fill_n(chains.y.data(), detail::widest, std::sqrt(1 / links));
      chains.solve(detail::widest, true);
      y0 = chains.y[0];
      beta0 = chains.beta[0];
      rest = chains.grown[0];
    }
    for (std::size_t begin = 0; begin < n; begin += chains.y.size()) {
      const std::size_t m = std::min(chains.y.size(), n - begin);
      const double* const x = b.x.data() + begin;
      TUNICA_LANES
      for (std::size_t i = 0; i < m; ++i) chains.y[i] = std::sqrt((x[i] + 3) / 3 / links);
      chains.solve(m, energy);
      const auto set = [&](std::span<double> out, std::size_t row, const auto& value) {
        if (out.empty()) return;
        double* const to = out.data() + row * n + begin;
        TUNICA_LANES
        for (std::size_t i = 0; i < m; ++i) {
          const double found = value(i);
          to[i] = std::sqrt((x[i] + 3) / 3 / links) < 1 ? found : beyond;
        }
      };
      const Chains::Row &y = chains.y, &beta = chains.beta, &grown = chains.grown;
      const auto bend = [&](std::size_t i) { return 1 / chains.slope[i] - beta[i] / y[i]; };
      // ψ' = μ β/(6y),  dy/dx = 1/(6Ny),  dy/dN = −y/(2N),  dβ/dy = 1/L'
      set(b.value, 0, [&](std::size_t i) { return mu * links * (grown[i] - rest); });
      set(b.first, 0, [&](std::size_t i) { return mu * beta[i] / (6 * y[i]); });
      set(b.second, 0, [&](std::size_t i) { return mu * bend(i) / (36 * links * y[i] * y[i]); });
      set(b.value_dp, 0, [&](std::size_t i) { return links * (grown[i] - rest); });
      set(b.value_dp, 1, [&](std::size_t i) { return mu * (grown[i] - rest - 0.5 * (y[i] * beta[i] - y0 * beta0)); });
      set(b.first_dp, 0, [&](std::size_t i) { return beta[i] / (6 * y[i]); });
      set(b.first_dp, 1, [&](std::size_t i) { return -mu * bend(i) / (12 * links); });
    }
  }
};

}  // namespace tunica::laws
