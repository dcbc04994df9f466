// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "conformance/function_problem.hpp"

namespace tunica::conformance {

/// A sum of squares on [lower, upper]^n, given over the box's own coordinates y; the Jacobian is scaled to x.
template <class Residuals>
Function least_squares(std::string name, std::size_t n, std::size_t m, double lower, double upper,
                       Residuals residuals) {
  Function function;
  function.name = std::move(name);
  function.dimension = n;
  function.residual_count = m;
  function.blocks = {{0, m, 1, ResidualBlock::Loss::quadratic}};
  function.start.assign(n, 0.25);
  function.residuals = [=, y = std::vector<double>(n)](std::span<const double> x, std::span<double> r,
                                                       std::span<double> jacobian) mutable {
    for (std::size_t i = 0; i < n; ++i) y[i] = lower + (upper - lower) * x[i];
    std::fill(jacobian.begin(), jacobian.end(), 0.0);
    residuals(y, r, jacobian);
    for (double& entry : jacobian) entry *= upper - lower;
    return true;
  };
  return function;
}

/// Σ (y_i − i/(n+1))²: an optimum at no special place.
inline Function sphere(std::size_t n) {
  return least_squares("sphere", n, n, -2, 3, [n](const auto& y, std::span<double> r, std::span<double> jacobian) {
    for (std::size_t i = 0; i < n; ++i) {
      r[i] = y[i] - static_cast<double>(i + 1) / static_cast<double>(n + 1);
      if (!jacobian.empty()) jacobian[i * n + i] = 1;
    }
  });
}

/// Σ 10^(6 i/(n−1)) z_i², z = H(y − c) with the Householder reflection H = I − 2vvᵀ, v = (1, …, 1)/√n: condition
/// number 1e6, axes oblique to the box.
inline Function ellipsoid(std::size_t n) {
  return least_squares("ellipsoid", n, n, -2, 3, [n](const auto& y, std::span<double> r, std::span<double> jacobian) {
    const double size = static_cast<double>(n);
    double mean = 0;
    for (const double value : y) mean += (value - 0.3) / size;
    for (std::size_t i = 0; i < n; ++i) {
      const double a = std::pow(10.0, 3.0 * static_cast<double>(i) / (size - 1));
      r[i] = a * (y[i] - 0.3 - 2 * mean);
      if (jacobian.empty()) continue;
      for (std::size_t j = 0; j < n; ++j) jacobian[i * n + j] = a * ((i == j ? 1.0 : 0.0) - 2 / size);
    }
  });
}

/// Rosenbrock's curved valley, chained: Σ 100 (y_{i+1} − y_i²)² + (1 − y_i)².
inline Function rosenbrock(std::size_t n) {
  return least_squares("rosenbrock", n, 2 * (n - 1), -2, 2,
                       [n](const auto& y, std::span<double> r, std::span<double> jacobian) {
                         for (std::size_t i = 0; i + 1 < n; ++i) {
                           r[2 * i] = 10 * (y[i + 1] - y[i] * y[i]);
                           r[2 * i + 1] = 1 - y[i];
                           if (jacobian.empty()) continue;
                           jacobian[2 * i * n + i + 1] = 10;
                           jacobian[2 * i * n + i] = -20 * y[i];
                           jacobian[(2 * i + 1) * n + i] = -1;
                         }
                       });
}

/// Rastrigin: Σ y² + 10 (1 − cos 2πy) = Σ y² + 20 sin² πy, about 10^n local minima.
inline Function rastrigin(std::size_t n) {
  return least_squares("rastrigin", n, 2 * n, -4.9, 5.3,
                       [n](const auto& y, std::span<double> r, std::span<double> jacobian) {
                         using std::numbers::pi;
                         for (std::size_t i = 0; i < n; ++i) {
                           r[2 * i] = y[i];
                           r[2 * i + 1] = std::sqrt(20.0) * std::sin(pi * y[i]);
                           if (jacobian.empty()) continue;
                           jacobian[2 * i * n + i] = 1;
                           jacobian[(2 * i + 1) * n + i] = std::sqrt(20.0) * pi * std::cos(pi * y[i]);
                         }
                       });
}

}  // namespace tunica::conformance
