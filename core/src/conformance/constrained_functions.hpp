// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "conformance/functions.hpp"

namespace tunica::conformance {

/// Adds m inequality constraints to a function on [lower, upper]^n, given over the box's own coordinates y as
/// constraints(y, c, jacobian); the Jacobian is scaled to x.
template <class Constraints>
Function constrained(Function function, std::size_t m, double lower, double upper, Constraints constraints) {
  function.constraint_count = m;
  function.constraints = [=, y = std::vector<double>(function.dimension)](
                             std::span<const double> x, std::span<double> c, std::span<double> jacobian) mutable {
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = lower + (upper - lower) * x[i];
    std::fill(jacobian.begin(), jacobian.end(), 0.0);
    constraints(y, c, jacobian);
    for (double& entry : jacobian) entry *= upper - lower;
  };
  return function;
}

/// The sphere, and y_0 ≥ 1.5: of its optimum (1/3, 2/3) the first coordinate is not allowed.
inline Function half_sphere() {
  Function function = constrained(sphere(2), 1, -2, 3, [](const auto& y, std::span<double> c, std::span<double> d) {
    c[0] = 1.5 - y[0];
    if (!d.empty()) d[0] = -1;
  });
  function.name = "half_sphere";
  function.optimum = std::pow(1.5 - 1.0 / 3, 2);
  return function;
}

/// Rosenbrock's valley within the unit disc (MathWorks' example of fmincon): optimum 0.0456748 on the circle, at
/// (0.78642, 0.61770). The start (−1, −1) is infeasible.
inline Function rosenbrock_in_disc() {
  Function function = constrained(rosenbrock(2), 1, -2, 2, [](const auto& y, std::span<double> c, std::span<double> d) {
    c[0] = y[0] * y[0] + y[1] * y[1] - 1;
    if (!d.empty()) {
      d[0] = 2 * y[0];
      d[1] = 2 * y[1];
    }
  });
  function.name = "rosenbrock_in_disc";
  function.optimum = 0.04567480872;
  return function;
}

/// Problem 65 of Hock & Schittkowski (LNEMS 187, 1981): (y1 − y2)² + (y1 + y2 − 10)²/9 + (y3 − 5)² within a ball of
/// radius √48; optimum 0.9535288567. Here on [−5, 5]³, which leaves the optimum (3.65, 3.65, 4.62) where it is.
inline Function hock_schittkowski_65() {
  Function function =
      least_squares("hock_schittkowski_65", 3, 3, -5, 5, [](const auto& y, std::span<double> r, std::span<double> d) {
        r[0] = y[0] - y[1];
        r[1] = (y[0] + y[1] - 10) / 3;
        r[2] = y[2] - 5;
        if (!d.empty()) {
          d[0] = 1;
          d[1] = -1;
          d[3] = d[4] = 1.0 / 3;
          d[8] = 1;
        }
      });
  function = constrained(function, 1, -5, 5, [](const auto& y, std::span<double> c, std::span<double> d) {
    c[0] = y[0] * y[0] + y[1] * y[1] + y[2] * y[2] - 48;
    if (!d.empty())
      for (std::size_t i = 0; i < 3; ++i) d[i] = 2 * y[i];
  });
  function.optimum = 0.9535288567;
  return function;
}

/// As a fit with a limit that must hold along a whole curve: Σ_j (p(t_j) − e^(2t_j))² over 21 points of [0, 1], p of
/// degree 3 by y in [−8, 8], and p(t_j) ≤ 5 at 40 points up to t = 1, of which one or two are active.
inline Function limited_curve() {
  constexpr std::size_t rows = 21, limits = 40;
  const auto power = [](double t, std::size_t k) { return k == 0 ? 1.0 : k == 1 ? t : k == 2 ? t * t : t * t * t; };
  Function function =
      least_squares("limited_curve", 4, rows, -8, 8, [power](const auto& y, std::span<double> r, std::span<double> d) {
        for (std::size_t j = 0; j < rows; ++j) {
          const double t = static_cast<double>(j) / (rows - 1);
          r[j] = -std::exp(2 * t);
          for (std::size_t k = 0; k < 4; ++k) {
            r[j] += y[k] * power(t, k);
            if (!d.empty()) d[j * 4 + k] = power(t, k);
          }
        }
      });
  function = constrained(function, limits, -8, 8, [power](const auto& y, std::span<double> c, std::span<double> d) {
    for (std::size_t j = 0; j < limits; ++j) {
      const double t = static_cast<double>(j + 1) / limits;
      c[j] = -5;
      for (std::size_t k = 0; k < 4; ++k) {
        c[j] += y[k] * power(t, k);
        if (!d.empty()) d[j * 4 + k] = power(t, k);
      }
    }
  });
  function.name = "limited_curve";
  function.optimum = 11.673945;
  function.start.assign(4, 0.75);
  return function;
}

/// The sphere where nothing is feasible: c = 0.1 + (y_0 − 1)² is least at y_0 = 1.
inline Function nothing_feasible() {
  Function function = constrained(sphere(2), 1, -2, 3, [](const auto& y, std::span<double> c, std::span<double> d) {
    c[0] = 0.1 + (y[0] - 1) * (y[0] - 1);
    if (!d.empty()) d[0] = 2 * (y[0] - 1);
  });
  function.name = "nothing_feasible";
  return function;
}

}  // namespace tunica::conformance
