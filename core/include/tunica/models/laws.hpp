// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "tunica/detail/vector_math.hpp"
#include "tunica/energy_part.hpp"

/// Responses ψ(x; p) that many models share.
///
/// A law is a type with
///
///     static constexpr std::size_t parameter_count;
///     template <class T> static T energy(const T& x, std::span<const T> p);     // the formula
///     static void respond(std::span<const double> p, const ResponseBatch&);      // optional: by hand, for speed
///
/// Without `respond`, derivatives come from the formula by automatic differentiation (autodiff.hpp). With it, compare
/// the two in a test. All functions are thread-safe; overflow yields inf.
namespace tunica::laws {

/// ψ = (a/2) x: a neo-Hookean matrix with x = I1 − 3 and shear modulus a = μ.
struct Linear {
  static constexpr std::size_t parameter_count = 1;  ///< a, kPa

  /// ψ for any scalar type.
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    return 0.5 * p[0] * x;
  }
  /// Derivatives by hand: constants.
  static void respond(std::span<const double> p, const ResponseBatch& b) {
    const std::size_t n = b.x.size();
    for (std::size_t i = 0; i < b.value.size(); ++i) b.value[i] = 0.5 * p[0] * b.x[i];
    for (double& first : b.first) first = 0.5 * p[0];
    for (double& second : b.second) second = 0;
    for (std::size_t i = 0; i < b.value_dp.size(); ++i) b.value_dp[i] = 0.5 * b.x[i];
    for (std::size_t i = 0; i < b.first_dp.size() && i < n; ++i) b.first_dp[i] = 0.5;
  }
};

/// ψ = k1/(2 k2) [exp(k2 x²) − 1], with its limit (k1/2) x² at k2 = 0 (Holzapfel, Gasser, Ogden 2000, eq. 65).
struct Exponential {
  static constexpr std::size_t parameter_count = 2;  ///< k1 in kPa, k2

  /// ψ for any scalar type; 0/0 at k2 = 0, where respond() has the limit.
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    using std::exp;
    return p[0] / (2.0 * p[1]) * (exp(p[1] * x * x) - 1.0);
  }

  /// φ(y) = (e^y − 1)/y, series about 0: the limit k2 = 0 without a case.
  static double phi(double y) { return std::abs(y) < 1e-5 ? 1 + y / 2 + y * y / 6 : std::expm1(y) / y; }
  /// φ'(y) = (e^y (y − 1) + 1)/y², series about 0.
  static double phi_prime(double y) {
    if (std::abs(y) < 1e-2) return 1. / 2 + y * (1. / 3 + y * (1. / 8 + y * (1. / 30 + y * (1. / 144 + y / 840))));
    return (std::exp(y) * (y - 1) + 1) / (y * y);
  }

  /// Derivatives by hand, one exponential a point.
  static void respond(std::span<const double> p, const ResponseBatch& b) {
    const double k1 = p[0], k2 = p[1];
    const std::size_t n = b.x.size();
    const double* const x = b.x.data();
    // ψ = k1/2 x² φ(k2 x²)
    for (std::size_t i = 0; i < b.value.size(); ++i) b.value[i] = 0.5 * k1 * x[i] * x[i] * phi(k2 * x[i] * x[i]);
    if (!b.value_dp.empty()) {
      for (std::size_t i = 0; i < n; ++i) {
        const double x2 = x[i] * x[i];
        b.value_dp[i] = 0.5 * x2 * phi(k2 * x2);
        b.value_dp[n + i] = 0.5 * k1 * x2 * x2 * phi_prime(k2 * x2);
      }
    }
    // ψ' = k1 x e^{k2 x²},  ψ'' = k1 (1 + 2 k2 x²) e^{k2 x²},  ∂ψ'/∂k1 = x e^{k2 x²},  ∂ψ'/∂k2 = k1 x³ e^{k2 x²}
    double* const first = b.first.data();
    double* const second = b.second.data();
    double* const by_k1 = b.first_dp.data();
    double* const by_k2 = by_k1 + n;
    if (!b.first.empty() && !b.second.empty()) {  // one exponential for all
      if (b.first_dp.empty()) {
        TUNICA_LANES
        for (std::size_t i = 0; i < n; ++i) {
          const double y = k2 * x[i] * x[i], e = k1 * detail::lane_exp(y);
          first[i] = x[i] * e;
          second[i] = (1 + 2 * y) * e;
        }
      } else {
        TUNICA_LANES
        for (std::size_t i = 0; i < n; ++i) {
          const double x2 = x[i] * x[i], y = k2 * x2, e = detail::lane_exp(y), slope = x[i] * e;
          first[i] = k1 * slope;
          second[i] = (1 + 2 * y) * (k1 * e);
          by_k1[i] = slope;
          by_k2[i] = k1 * x2 * slope;
        }
      }
      return;
    }
    if (!b.first.empty()) {
      TUNICA_LANES
      for (std::size_t i = 0; i < n; ++i) first[i] = k1 * detail::lane_exp(k2 * x[i] * x[i]) * x[i];
    }
    if (!b.second.empty()) {
      TUNICA_LANES
      for (std::size_t i = 0; i < n; ++i) {
        const double y = k2 * x[i] * x[i];
        second[i] = (1 + 2 * y) * (k1 * detail::lane_exp(y));
      }
    }
    if (!b.first_dp.empty()) {
      TUNICA_LANES
      for (std::size_t i = 0; i < n; ++i) {
        const double x2 = x[i] * x[i];
        by_k1[i] = x[i] * detail::lane_exp(k2 * x2);
        by_k2[i] = k1 * x2 * by_k1[i];
      }
    }
  }
};

}  // namespace tunica::laws
