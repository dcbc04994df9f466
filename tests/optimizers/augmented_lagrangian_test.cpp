// SPDX-License-Identifier: Apache-2.0
#include "tunica/optimizers/augmented_lagrangian.hpp"

#include <gtest/gtest.h>

#include "conformance/constrained_functions.hpp"

namespace tunica::testing {
using namespace conformance;
namespace {

using Progress = AugmentedLagrangian::Progress;

/// min (y − 1/2)² on [−2, 3], y ≥ 1.5: the multiplier is 2 · 1 = 2, per unit of c = 1.5 − y.
Function one_dimension() {
  return constrained(sphere(1), 1, -2, 3, [](const auto& y, std::span<double> c, std::span<double> d) {
    c[0] = 1.5 - y[0];
    if (!d.empty()) d[0] = -1;
  });
}

/// Minimises L of one_dimension() in closed form: 2 (y − 1/2) = ρ (1.5 − y) + λ.
void minimise_exactly(AugmentedLagrangian& lagrangian) {
  const double rho = lagrangian.penalty(), lambda = lagrangian.multipliers()[0];
  const double y = (1 + rho * (1.5 + AugmentedLagrangian::margin) + lambda) / (2 + rho), x = (y + 2) / 5;
  double value = 0;
  ASSERT_TRUE(lagrangian.evaluate({&x, 1}, value).ok());
}

TEST(AugmentedLagrangian, AddsThePenaltyAsAResidualBlockWithItsJacobian) {
  FunctionProblem problem(hock_schittkowski_65(), {});
  AugmentedLagrangian lagrangian(problem);
  ASSERT_EQ(lagrangian.blocks().size(), 2u);
  EXPECT_EQ(lagrangian.constraint_count(), 0u);
  EXPECT_EQ(lagrangian.residual_count(), 4u);
  const std::vector<double> x = {0.95, 0.9, 0.97};
  std::vector<double> r(4), jacobian(12), above(4), below(4);
  double objective = 0, plain = 0;
  ASSERT_TRUE(lagrangian.linearise(x, objective, r, jacobian).ok()) << "infeasible points are ok here";
  EXPECT_EQ(problem.evaluate(x, plain).kind(), Status::Kind::infeasible);
  EXPECT_GT(r[3], 0);
  EXPECT_NEAR(objective, plain + r[3] * r[3], 1e-12 * objective);
  for (std::size_t j = 0; j < 3; ++j) {
    std::vector<double> moved = x;
    const double h = 1e-6;
    moved[j] = x[j] + h;
    ASSERT_TRUE(lagrangian.linearise(moved, objective, above, {}).ok());
    moved[j] = x[j] - h;
    ASSERT_TRUE(lagrangian.linearise(moved, objective, below, {}).ok());
    for (std::size_t i = 0; i < 4; ++i) {
      const double difference = (above[i] - below[i]) / (2 * h);
      EXPECT_NEAR(jacobian[i * 3 + j], difference, 1e-5 * (1 + std::abs(difference))) << i << j;
    }
  }
}

TEST(AugmentedLagrangian, FindsTheMultiplier) {
  FunctionProblem problem(one_dimension(), {});
  AugmentedLagrangian lagrangian(problem);
  double value = 0;
  ASSERT_TRUE(lagrangian.evaluate(problem.start(), value).ok());  // sets the penalty
  Progress progress = Progress::going_on;
  int rounds = 0;
  for (; rounds < 20 && progress == Progress::going_on; ++rounds) {
    minimise_exactly(lagrangian);
    progress = lagrangian.update();
  }
  EXPECT_EQ(progress, Progress::converged) << rounds;
  EXPECT_NEAR(lagrangian.multipliers()[0], 2, 1e-4);
  EXPECT_NEAR(lagrangian.best().objective, 1, 2e-6);
  EXPECT_EQ(lagrangian.best().violation, 0) << "the best point is feasible";
}

TEST(AugmentedLagrangian, ConvergesAtOnceWhereNoConstraintIsActive) {
  FunctionProblem problem(rosenbrock_in_disc(), {});
  AugmentedLagrangian lagrangian(problem);
  const std::vector<double> inside = {0.6, 0.55};
  double value = 0;
  ASSERT_TRUE(lagrangian.evaluate(inside, value).ok());
  EXPECT_EQ(lagrangian.update(), Progress::converged);
  EXPECT_EQ(lagrangian.multipliers()[0], 0);
}

TEST(AugmentedLagrangian, LeavesThePenaltyOutUntilTheObjectiveAloneHasLedOutOfTheFeasibleRegion) {
  FunctionProblem problem(one_dimension(), {});
  AugmentedLagrangian lagrangian(problem, AugmentedLagrangian::First::objective_alone);
  const double optimum = 0.5;  // y = 1/2, where f = 0 and c = 1
  double objective = 1;
  std::vector<double> r(2), jacobian(2);
  ASSERT_TRUE(lagrangian.linearise({&optimum, 1}, objective, r, jacobian).ok());
  EXPECT_EQ(objective, 0) << "no penalty yet";
  EXPECT_EQ(r[1], 0);
  EXPECT_EQ(jacobian[1], 0);
  EXPECT_EQ(lagrangian.best().violation, 1) << "though it is known that the point is not feasible";
  EXPECT_EQ(lagrangian.update(), Progress::going_on);
  EXPECT_EQ(lagrangian.multipliers()[0], 0);
  ASSERT_TRUE(lagrangian.linearise({&optimum, 1}, objective, r, jacobian).ok());
  EXPECT_GT(objective, 0);
  EXPECT_GT(r[1], 0);
  EXPECT_LT(jacobian[1], 0);
  Progress progress = Progress::going_on;
  for (int rounds = 0; rounds < 20 && progress == Progress::going_on; ++rounds) {
    minimise_exactly(lagrangian);
    progress = lagrangian.update();
  }
  EXPECT_EQ(progress, Progress::converged);
  EXPECT_NEAR(lagrangian.multipliers()[0], 2, 1e-4);
  EXPECT_NEAR(lagrangian.best().objective, 1, 2e-6);
}

TEST(AugmentedLagrangian, BeginsThePenaltyWithATenthOfWhatTheFirstPointSaid) {
  FunctionProblem problem(one_dimension(), {});
  AugmentedLagrangian lagrangian(problem, AugmentedLagrangian::First::objective_alone);
  const double start = 1, optimum = 0.5;  // y = 3: f = 6.25, feasible: 10 f / max(1, ½ Σ max(0, c)²) = 62.5
  double value = 0;
  ASSERT_TRUE(lagrangian.evaluate({&start, 1}, value).ok());
  ASSERT_TRUE(lagrangian.evaluate({&optimum, 1}, value).ok());
  ASSERT_EQ(lagrangian.update(), Progress::going_on);
  EXPECT_NEAR(lagrangian.penalty(), 6.25, 1e-12);
  minimise_exactly(lagrangian);
  ASSERT_EQ(lagrangian.update(), Progress::going_on);
  EXPECT_NEAR(lagrangian.penalty(), 6.25, 1e-12) << "the first minimisation with it changes no more than λ";
}

TEST(AugmentedLagrangian, IsDoneWithTheObjectiveAloneWhereItsOptimumIsFeasible) {
  FunctionProblem problem(rosenbrock_in_disc(), {});
  AugmentedLagrangian lagrangian(problem, AugmentedLagrangian::First::objective_alone);
  const std::vector<double> outside = {0.95, 0.95}, inside = {0.6, 0.55};
  double value = 0, plain = 0;
  ASSERT_TRUE(lagrangian.evaluate(outside, value).ok());
  ASSERT_EQ(problem.evaluate(outside, plain).kind(), Status::Kind::infeasible);
  EXPECT_EQ(value, plain) << "not feasible, and not penalised";
  ASSERT_TRUE(lagrangian.evaluate(inside, value).ok());
  EXPECT_EQ(lagrangian.update(), Progress::converged);
  EXPECT_EQ(lagrangian.best().x, inside);
}

TEST(AugmentedLagrangian, SaysWhenTheConstraintsCannotBeMet) {
  FunctionProblem problem(nothing_feasible(), {});
  AugmentedLagrangian lagrangian(problem);
  const std::vector<double> x = {0.6, 0.5};  // where the violation is least
  double value = 0;
  Progress progress = Progress::going_on;
  for (int k = 0; k < 100 && progress == Progress::going_on; ++k) {
    ASSERT_TRUE(lagrangian.evaluate(x, value).ok());
    progress = lagrangian.update();
  }
  EXPECT_EQ(progress, Progress::infeasible);
  EXPECT_NEAR(lagrangian.best().violation, 0.1, 1e-12);
}

TEST(AugmentedLagrangian, SaysWhenNothingCouldBeEvaluated) {
  FunctionProblem problem(half_sphere(), {.failure_rate = 2});
  AugmentedLagrangian lagrangian(problem);
  EXPECT_EQ(lagrangian.update(), Progress::nothing);
  double value = 0;
  EXPECT_EQ(lagrangian.evaluate(problem.start(), value).kind(), Status::Kind::failed);
  EXPECT_EQ(lagrangian.update(), Progress::nothing);
  EXPECT_TRUE(lagrangian.best().x.empty());
}

TEST(AugmentedLagrangian, GivesBatchesAndStartsTheSameValues) {
  FunctionProblem problem(half_sphere(), {});
  AugmentedLagrangian lagrangian(problem);
  const std::vector<double> xs = {0.2, 0.3, 0.9, 0.4};
  std::vector<double> batch(2);
  std::vector<Status> statuses(2);
  lagrangian.evaluate_batch(xs, batch, statuses);
  for (std::size_t k = 0; k < 2; ++k) {
    double one = 0, of_child = 0;
    ASSERT_TRUE(lagrangian.evaluate(std::span(xs).subspan(2 * k, 2), one).ok());
    EXPECT_EQ(batch[k], one);
    lagrangian.for_each_start(1, [&](std::size_t, Problem& child) {
      ASSERT_TRUE(child.evaluate(std::span(xs).subspan(2 * k, 2), of_child).ok());
    });
    EXPECT_EQ(of_child, one);
  }
}

}  // namespace
}  // namespace tunica::testing
