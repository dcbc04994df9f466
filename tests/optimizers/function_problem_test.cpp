// SPDX-License-Identifier: Apache-2.0
// The test doubles themselves: a wrong Jacobian here would be blamed on the optimisers.
#include <gtest/gtest.h>

#include "conformance/constrained_functions.hpp"
#include "optimizers/lamb_aorta.hpp"

namespace tunica::testing {
using namespace conformance;
namespace {

void expect_jacobian_is_the_derivative(const Function& function, std::vector<double> x) {
  const std::size_t n = function.dimension, m = function.residual_count;
  std::vector<double> r(m), jacobian(m * n), above(m), below(m);
  ASSERT_TRUE(function.residuals(x, r, jacobian));
  const double h = 1e-6;
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<double> y = x;
    y[j] = x[j] + h;
    ASSERT_TRUE(function.residuals(y, above, {}));
    y[j] = x[j] - h;
    ASSERT_TRUE(function.residuals(y, below, {}));
    for (std::size_t i = 0; i < m; ++i) {
      const double difference = (above[i] - below[i]) / (2 * h);
      EXPECT_NEAR(jacobian[i * n + j], difference, 1e-5 * (1 + std::abs(difference))) << function.name << i << j;
    }
  }
}

TEST(StandardFunctions, HaveExactJacobians) {
  for (const Function& function : {sphere(3), ellipsoid(3), rosenbrock(3), rastrigin(3)}) {
    expect_jacobian_is_the_derivative(function, {0.31, 0.77, 0.42});
  }
}

TEST(ConstrainedFunctions, HaveExactJacobians) {
  for (const Function& function :
       {half_sphere(), rosenbrock_in_disc(), hock_schittkowski_65(), limited_curve(), nothing_feasible()}) {
    const std::vector<double> x(function.dimension, 0.37);
    expect_jacobian_is_the_derivative(function, x);
    Function constraints = function;
    constraints.residual_count = function.constraint_count;
    constraints.residuals = [&function](std::span<const double> at, std::span<double> c, std::span<double> jacobian) {
      function.constraints(at, c, jacobian);
      return true;
    };
    expect_jacobian_is_the_derivative(constraints, x);
  }
}

TEST(LambAorta, HasAnExactJacobian) {
  const auto function = lamb_aorta();
  ASSERT_TRUE(function) << "examples/lamb_aorta has lost its strips";
  expect_jacobian_is_the_derivative(*function, {0.22, 0.6, 0.4, 0.15, 0.01, 0.63});
}

TEST(LambAorta, HasThePublishedOptimumAnywhereOnItsValley) {
  const auto function = lamb_aorta();
  ASSERT_TRUE(function) << "examples/lamb_aorta has lost its strips";
  FunctionProblem problem(*function, {});
  // 2A + B = 0.79666 and B cos 2θ = −0.16076, θ from the axial direction.
  for (const double b : {0.25, 0.39, 0.7}) {
    const double angle = 0.5 * std::acos(-0.16076 / b);
    const double x[] = {0.22386, 1.5 * (0.79666 - b), b, 0.15097, 0.03602 / 3, angle / (0.5 * std::numbers::pi)};
    double objective = 0;
    ASSERT_TRUE(problem.evaluate(x, objective).ok());
    EXPECT_NEAR(objective, 66.1000, 5e-4);
  }
}

}  // namespace
}  // namespace tunica::testing
