// SPDX-License-Identifier: Apache-2.0
// A linear problem of the size that rubber at large stretches has: the objective falls from 1e16 in the box to 1e4.
#include <cmath>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "conformance/functions.hpp"
#include "optimizers/plugin_under_test.hpp"

namespace tunica::testing {
using namespace conformance;
namespace {

constexpr std::size_t rows = 200;

/// Yeoh's coefficients c10, c20, c30 in [−1000, 1000], [−100, 100] and [−10, 10] kPa, nominal stress at stretches to 18
/// with a ripple of 10 kPa that no coefficient follows.
Function rubber() {
  Eigen::Matrix<double, Eigen::Dynamic, 3> columns(rows, 3);
  Eigen::VectorXd measured(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    const double l = 1.05 + (18 - 1.05) * static_cast<double>(i) / (rows - 1), x = l * l + 2 / l - 3;
    const double factor = 2 * (l - 1 / (l * l));
    const auto row = static_cast<Eigen::Index>(i);
    columns.row(row) << factor * 1, factor * 2 * x, factor * 3 * x * x;
    measured[row] = columns.row(row).dot(Eigen::Vector3d(19.63, -0.0797, 0.00088877)) + 10 * std::sin(5 * l);
  }
  columns.col(0) *= 1000;
  columns.col(1) *= 100;
  columns.col(2) *= 10;
  // The columns are dependent to 1e-4 of their sizes: not by the normal equations.
  const Eigen::Vector3d best = columns.colPivHouseholderQr().solve(measured);
  Function function = least_squares(
      "rubber", 3, rows, -1, 1, [columns, measured](const auto& y, std::span<double> r, std::span<double> jacobian) {
        for (std::size_t i = 0; i < rows; ++i) {
          const auto row = static_cast<Eigen::Index>(i);
          r[i] = columns.row(row).dot(Eigen::Vector3d(y[0], y[1], y[2])) - measured[row];
          for (std::size_t j = 0; !jacobian.empty() && j < 3; ++j)
            jacobian[i * 3 + j] = columns(row, static_cast<Eigen::Index>(j));
        }
      });
  function.optimum = (columns * best - measured).squaredNorm();
  return function;
}

/// The best objective of 20 starts, or of a search in as many evaluations as the program allows, over the optimum.
double excess(const std::string& type, Given given) {
  const Function function = rubber();
  FunctionProblem problem(function, {.budget = 60000});
  make_optimizer(type, std::move(given))->minimise(problem);
  return problem.best / function.optimum - 1;
}

TEST(LinearProblem, IsSolvedToRoundingWithDerivatives) {
  EXPECT_LE(excess("ceres_lm", {}), 1e-8);
  EXPECT_LE(excess("nlopt", {{"algorithm", "slsqp"}}), 1e-8);
}

TEST(LinearProblem, IsSolvedWithoutDerivatives) {
  EXPECT_LE(excess("nlopt", {{"algorithm", "bobyqa"}}), 1e-6);
  EXPECT_LE(excess("nlopt", {{"algorithm", "crs2_lm"}}), 1e-6);
  EXPECT_LE(excess("cma_es", {}), 1e-6);
  EXPECT_LE(excess("es", {}), 1e-6);
}

}  // namespace
}  // namespace tunica::testing
