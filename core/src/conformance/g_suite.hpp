// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "conformance/function_problem.hpp"

namespace tunica::conformance {

/// Problems of Michalewicz & Schoenauer (1996), numbered as by Runarsson & Yao (2000, 2005), each with several
/// constraints active at the optimum. The objective has to be a sum of squares here: r = √(f + offset), where the
/// offset keeps the root real. Without Jacobians: for methods that compare values.
struct GProblem {
  const char* name;
  std::vector<double> lower, upper;
  std::size_t constraint_count;
  double offset, optimum;  ///< of f
  double (*objective)(const double* x);
  void (*constraints)(const double* x, double* c);
};

inline const std::vector<GProblem>& g_suite() {
  static const std::vector<GProblem> suite = {
      {"g04",
       {78, 33, 27, 27, 27},
       {102, 45, 45, 45, 45},
       6,
       40792.141,
       -30665.53867178332,
       [](const double* x) { return 5.3578547 * x[2] * x[2] + 0.8356891 * x[0] * x[4] + 37.293239 * x[0] - 40792.141; },
       [](const double* x, double* c) {
         const double a = 85.334407 + 0.0056858 * x[1] * x[4] + 0.0006262 * x[0] * x[3] - 0.0022053 * x[2] * x[4];
         const double b = 80.51249 + 0.0071317 * x[1] * x[4] + 0.0029955 * x[0] * x[1] + 0.0021813 * x[2] * x[2];
         const double d = 9.300961 + 0.0047026 * x[2] * x[4] + 0.0012547 * x[0] * x[2] + 0.0019085 * x[2] * x[3];
         c[0] = a - 92;
         c[1] = -a;
         c[2] = b - 110;
         c[3] = 90 - b;
         c[4] = d - 25;
         c[5] = 20 - d;
       }},
      {"g06",
       {13, 0},
       {100, 100},
       2,
       8000,
       -6961.81387558015,
       [](const double* x) { return std::pow(x[0] - 10, 3) + std::pow(x[1] - 20, 3); },
       [](const double* x, double* c) {
         c[0] = 100 - std::pow(x[0] - 5, 2) - std::pow(x[1] - 5, 2);
         c[1] = std::pow(x[0] - 6, 2) + std::pow(x[1] - 5, 2) - 82.81;
       }},
      {"g07", std::vector<double>(10, -10), std::vector<double>(10, 10), 8, 100, 24.30620906818,
       [](const double* x) {
         const auto square = [](double value) { return value * value; };
         return x[0] * x[0] + x[1] * x[1] + x[0] * x[1] - 14 * x[0] - 16 * x[1] + square(x[2] - 10) +
                4 * square(x[3] - 5) + square(x[4] - 3) + 2 * square(x[5] - 1) + 5 * x[6] * x[6] +
                7 * square(x[7] - 11) + 2 * square(x[8] - 10) + square(x[9] - 7) + 45;
       },
       [](const double* x, double* c) {
         const auto square = [](double value) { return value * value; };
         c[0] = -105 + 4 * x[0] + 5 * x[1] - 3 * x[6] + 9 * x[7];
         c[1] = 10 * x[0] - 8 * x[1] - 17 * x[6] + 2 * x[7];
         c[2] = -8 * x[0] + 2 * x[1] + 5 * x[8] - 2 * x[9] - 12;
         c[3] = 3 * square(x[0] - 2) + 4 * square(x[1] - 3) + 2 * x[2] * x[2] - 7 * x[3] - 120;
         c[4] = 5 * x[0] * x[0] + 8 * x[1] + square(x[2] - 6) - 2 * x[3] - 40;
         c[5] = x[0] * x[0] + 2 * square(x[1] - 2) - 2 * x[0] * x[1] + 14 * x[4] - 6 * x[5];
         c[6] = 0.5 * square(x[0] - 8) + 2 * square(x[1] - 4) + 3 * x[4] * x[4] - x[5] - 30;
         c[7] = -3 * x[0] + 6 * x[1] + 12 * square(x[8] - 8) - 7 * x[9];
       }},
      {"g09", std::vector<double>(7, -10), std::vector<double>(7, 10), 4, 1000, 680.630057374402,
       [](const double* x) {
         const auto square = [](double value) { return value * value; };
         return square(x[0] - 10) + 5 * square(x[1] - 12) + std::pow(x[2], 4) + 3 * square(x[3] - 11) +
                10 * std::pow(x[4], 6) + 7 * x[5] * x[5] + std::pow(x[6], 4) - 4 * x[5] * x[6] - 10 * x[5] - 8 * x[6];
       },
       [](const double* x, double* c) {
         c[0] = -127 + 2 * x[0] * x[0] + 3 * std::pow(x[1], 4) + x[2] + 4 * x[3] * x[3] + 5 * x[4];
         c[1] = -282 + 7 * x[0] + 3 * x[1] + 10 * x[2] * x[2] + x[3] - x[4];
         c[2] = -196 + 23 * x[0] + x[1] * x[1] + 6 * x[5] * x[5] - 8 * x[6];
         c[3] = 4 * x[0] * x[0] + x[1] * x[1] - 3 * x[0] * x[1] + 2 * x[2] * x[2] + 5 * x[5] - 11 * x[6];
       }},
      {"g10",
       {100, 1000, 1000, 10, 10, 10, 10, 10},
       {10000, 10000, 10000, 1000, 1000, 1000, 1000, 1000},
       6,
       0,
       7049.24802052867,
       [](const double* x) { return x[0] + x[1] + x[2]; },
       [](const double* x, double* c) {
         c[0] = -1 + 0.0025 * (x[3] + x[5]);
         c[1] = -1 + 0.0025 * (x[4] + x[6] - x[3]);
         c[2] = -1 + 0.01 * (x[7] - x[4]);
         c[3] = -x[0] * x[5] + 833.33252 * x[3] + 100 * x[0] - 83333.333;
         c[4] = -x[1] * x[6] + 1250 * x[4] + x[1] * x[3] - 1250 * x[3];
         c[5] = -x[2] * x[7] + 1250000 + x[2] * x[4] - 2500 * x[4];
       }},
  };
  return suite;
}

/// As a Function; the optimum is that of f + offset.
inline Function g_function(const GProblem& g) {
  Function function;
  function.name = g.name;
  function.dimension = g.lower.size();
  function.residual_count = 1;
  function.blocks = {{0, 1, 1, ResidualBlock::Loss::quadratic}};
  function.start.assign(function.dimension, 0.5);
  function.optimum = g.optimum + g.offset;
  function.constraint_count = g.constraint_count;
  const auto at = [g](std::span<const double> x) {
    std::vector<double> y(x.size());
    for (std::size_t j = 0; j < y.size(); ++j) y[j] = g.lower[j] + (g.upper[j] - g.lower[j]) * x[j];
    return y;
  };
  function.residuals = [g, at](std::span<const double> x, std::span<double> r, std::span<double> jacobian) {
    r[0] = std::sqrt(g.objective(at(x).data()) + g.offset);
    return jacobian.empty() && std::isfinite(r[0]);
  };
  function.constraints = [g, at](std::span<const double> x, std::span<double> c, std::span<double>) {
    g.constraints(at(x).data(), c.data());
  };
  return function;
}

}  // namespace tunica::conformance
