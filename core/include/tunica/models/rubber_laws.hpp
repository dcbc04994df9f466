// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "tunica/models/laws.hpp"

/// Responses of rubber. laws.hpp defines what a law is.
namespace tunica::laws {

/// ψ = c x: a term of Mooney's energy, x = I1 − 3 or I2 − 3 (Mooney 1940; Rivlin 1948).
struct Proportional {
  static constexpr std::size_t parameter_count = 1;  ///< c, kPa

  /// ψ for any scalar type.
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    return p[0] * x;
  }
};

/// ψ = c10 x + c20 x² + c30 x³, x = I1 − 3 (Yeoh 1993).
struct Cubic {
  static constexpr std::size_t parameter_count = 3;  ///< c10, c20, c30, kPa

  /// ψ for any scalar type.
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    return x * (p[0] + x * (p[1] + x * p[2]));
  }
};

/// ψ = −(μ Jm/2) ln(1 − x/Jm), x = I1 − 3 (Gent 1996). At x = Jm the chains reach their full length; from there on
/// every number is infinite. Derivatives are by hand: beyond the limit ln is not a number, but its derivative would be
/// one.
struct Gent {
  static constexpr std::size_t parameter_count = 2;  ///< μ in kPa, Jm

  /// ψ for any scalar type; not a number beyond the limit.
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    using std::log;
    return -0.5 * p[0] * p[1] * log(1.0 - x / p[1]);
  }

  /// Derivatives by hand, infinite from x = Jm on.
  static void respond(std::span<const double> p, const ResponseBatch& b) {
    constexpr double beyond = std::numeric_limits<double>::infinity();
    const double mu = p[0], limit = p[1];
    const std::size_t n = b.x.size();
    for (std::size_t i = 0; i < n; ++i) {
      const double x = b.x[i], left = limit - x;
      const bool defined = left > 0;
      const double q = defined ? 1 / left : beyond;
      if (!b.value.empty()) b.value[i] = defined ? -0.5 * mu * limit * std::log1p(-x / limit) : beyond;
      // ψ' = (μ/2) Jm/(Jm − x),  ψ'' = (μ/2) Jm/(Jm − x)²
      if (!b.first.empty()) b.first[i] = 0.5 * mu * limit * q;
      if (!b.second.empty()) b.second[i] = 0.5 * mu * limit * q * q;
      // ∂ψ'/∂μ = ½ Jm/(Jm − x),  ∂ψ'/∂Jm = −(μ/2) x/(Jm − x)²
      if (!b.first_dp.empty()) {
        b.first_dp[i] = 0.5 * limit * q;
        b.first_dp[n + i] = -0.5 * mu * x * q * q;
      }
      if (!b.value_dp.empty()) {
        const double logarithm = defined ? std::log1p(-x / limit) : beyond;
        b.value_dp[i] = -0.5 * limit * logarithm;
        b.value_dp[n + i] = -0.5 * mu * (logarithm + x * q);
      }
    }
  }
};

/// w(λ) = Σ_i (μ_i/α_i) (λ^α_i − 1), the share of one principal stretch in Ogden's energy (Ogden 1972);
/// parameters μ_1, α_1, μ_2, α_2, …. At α_i = 0 the limit μ_i ln λ.
template <std::size_t terms>
struct Ogden {
  static constexpr std::size_t parameter_count = 2 * terms;  ///< μ_i in kPa, α_i

  /// w for any scalar type; 0/0 at α_i = 0, where respond() has the limit.
  template <class T>
  static T energy(const T& lambda, std::span<const T> p) {
    using std::exp, std::log;
    T sum{};
    for (std::size_t k = 0; k < terms; ++k) sum += p[2 * k] / p[2 * k + 1] * (exp(p[2 * k + 1] * log(lambda)) - 1.0);
    return sum;
  }

  /// Derivatives by hand, one logarithm a point and one exponential a term.
  static void respond(std::span<const double> p, const ResponseBatch& b) {
    const std::size_t n = b.x.size();
    constexpr std::size_t chunk = 64;
    alignas(16) std::array<double, chunk> l, inverse, e;
    for (std::size_t begin = 0; begin < n; begin += chunk) {
      const std::size_t m = n - begin < chunk ? n - begin : chunk;
      const auto clear = [begin, m](std::span<double> row) {
        for (std::size_t i = 0; !row.empty() && i < m; ++i) row[begin + i] = 0;
      };
      clear(b.value);
      clear(b.first);
      clear(b.second);
      for (std::size_t i = 0; i < m; ++i) {
        l[i] = detail::lane_log(b.x[begin + i]);
        inverse[i] = 1 / b.x[begin + i];
      }
      for (std::size_t k = 0; k < terms; ++k) {
        const double mu = p[2 * k], alpha = p[2 * k + 1];
        for (std::size_t i = 0; i < m; ++i) e[i] = detail::lane_exp(alpha * l[i]);
        // w' = Σ μ λ^(α−1),  w'' = Σ μ (α − 1) λ^(α−2)
        for (std::size_t i = 0; !b.first.empty() && i < m; ++i) b.first[begin + i] += mu * e[i] * inverse[i];
        for (std::size_t i = 0; !b.second.empty() && i < m; ++i)
          b.second[begin + i] += mu * (alpha - 1) * e[i] * inverse[i] * inverse[i];
        // ∂w'/∂μ = λ^(α−1),  ∂w'/∂α = μ ln λ λ^(α−1)
        for (std::size_t i = 0; !b.first_dp.empty() && i < m; ++i) {
          b.first_dp[2 * k * n + begin + i] = e[i] * inverse[i];
          b.first_dp[(2 * k + 1) * n + begin + i] = mu * l[i] * e[i] * inverse[i];
        }
        // (λ^α − 1)/α = ln λ φ(α ln λ)
        for (std::size_t i = 0; !b.value.empty() && i < m; ++i)
          b.value[begin + i] += mu * l[i] * Exponential::phi(alpha * l[i]);
        for (std::size_t i = 0; !b.value_dp.empty() && i < m; ++i) {
          b.value_dp[2 * k * n + begin + i] = l[i] * Exponential::phi(alpha * l[i]);
          b.value_dp[(2 * k + 1) * n + begin + i] = mu * l[i] * l[i] * Exponential::phi_prime(alpha * l[i]);
        }
      }
    }
  }
};

}  // namespace tunica::laws
