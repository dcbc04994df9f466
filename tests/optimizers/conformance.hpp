// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "optimizers/constrained_functions.hpp"
#include "optimizers/plugin_under_test.hpp"

// The shared property checks of every Optimizer. Include in one file of a test executable and instantiate:
//   INSTANTIATE_TEST_SUITE_P(Es, OptimizerConformance, testing::Values(Subject{.label = "plus", .type = "es"}), label);

namespace tunica::testing {

struct Subject {
  std::string label;  ///< letters, digits, underscores
  std::string type;   ///< plugin and optimiser
  Given options = {};
  std::uint64_t budget = 60000;  ///< evaluations that suffice for each of the standard functions
  bool oblique = true;           ///< expected to solve the ill-conditioned functions too
  double boundary = 1e-3;        ///< expected relative closeness to an optimum on the boundary of the feasible set
};

inline std::string label(const ::testing::TestParamInfo<Subject>& info) { return info.param.label; }
inline void PrintTo(const Subject& subject, std::ostream* out) { *out << subject.type << " " << subject.label; }

class OptimizerConformance : public ::testing::TestWithParam<Subject> {
 protected:
  static std::unique_ptr<Optimizer> make() { return make_optimizer(GetParam().type, GetParam().options); }
  /// Runs the subject on the function; the contract's breaches are checked here for every test.
  static Optimizer::Outcome run(FunctionProblem& problem) {
    const auto optimizer = make();
    const Optimizer::Outcome outcome = optimizer->minimise(problem);
    EXPECT_EQ(problem.outside, 0u) << "points outside the unit box were asked for";
    EXPECT_EQ(problem.refused, 0u) << "evaluations were asked for after should_stop() or beyond the budget";
    EXPECT_FALSE(outcome.reason.empty());
    const Optimizer::Needs& needs = optimizer->needs();
    EXPECT_TRUE(needs.gradient || problem.jacobians == 0) << "a Jacobian was asked for that is not declared as a need";
    EXPECT_TRUE((needs.gradient && needs.constraints) || problem.constraint_jacobians == 0)
        << "a Jacobian of the constraints was asked for that is not declared as a need";
    EXPECT_TRUE(needs.batch || problem.batches == 0) << "evaluate_batch was used but is not declared as a need";
    return outcome;
  }
  static void expect_solves(Function function) {
    // The standard functions have one minimum, or a basin that all but one start in hundreds falls into; seed 1.
    const std::string name = function.name;
    FunctionProblem problem(std::move(function), {.budget = GetParam().budget, .target = 1e-8});
    const auto outcome = run(problem);
    EXPECT_LE(problem.best, 1e-8) << name << ": " << outcome.reason;
  }
};

TEST_P(OptimizerConformance, DeclaresItselfInFull) {
  const OptimizerFactory factory = factory_of(GetParam().type);
  EXPECT_FALSE(factory.doc.empty());
  EXPECT_FALSE(factory.reference.empty());
  for (const Option& option : factory.options) {
    EXPECT_TRUE(option.doc.ends_with('.')) << option.name << ": one sentence is expected, found: " << option.doc;
    EXPECT_TRUE(option.fallback.has_value()) << option.name;
    EXPECT_EQ(option.kind == Option::Kind::choice, !option.choices.empty()) << option.name;
  }
}

TEST_P(OptimizerConformance, FindsTheOptimumOfTheSphere) { expect_solves(sphere(4)); }

TEST_P(OptimizerConformance, FindsTheOptimumOfAnObliqueEllipsoidOfConditionOneMillion) {
  if (!GetParam().oblique) GTEST_SKIP() << "adapts to no directions";
  expect_solves(ellipsoid(4));
}

TEST_P(OptimizerConformance, FindsTheOptimumAtTheEndOfACurvedValley) {
  if (!GetParam().oblique) GTEST_SKIP() << "adapts to no directions";
  expect_solves(rosenbrock(2));
}

TEST_P(OptimizerConformance, SolvesOneDimension) { expect_solves(sphere(1)); }

TEST_P(OptimizerConformance, EvaluatesOnceWhenNothingIsFree) {
  FunctionProblem problem(sphere(0), {});
  EXPECT_TRUE(run(problem).converged);
  EXPECT_EQ(problem.evaluations(), 1u);
}

TEST_P(OptimizerConformance, KeepsTheBoundsWhereTheOptimumLiesOnThem) {
  // Σ (y_i − c_i)² on [−2, 3]³ with c = (5, −4, 0.5): the optimum in the box is (3, −2, 0.5), objective 8.
  const double centre[] = {5, -4, 0.5};
  FunctionProblem problem(least_squares("corner", 3, 3, -2, 3,
                                        [centre](const auto& y, std::span<double> r, std::span<double> jacobian) {
                                          for (std::size_t i = 0; i < 3; ++i) {
                                            r[i] = y[i] - centre[i];
                                            if (!jacobian.empty()) jacobian[i * 3 + i] = 1;
                                          }
                                        }),
                          {.budget = GetParam().budget});
  run(problem);
  EXPECT_NEAR(problem.best, 8, 1e-3);
}

TEST_P(OptimizerConformance, RepeatsItselfBitForBitWithTheSameSeed) {
  FunctionProblem first(rosenbrock(3), {.budget = 2000, .seed = 5, .remember = true});
  FunctionProblem second(rosenbrock(3), {.budget = 2000, .seed = 5, .remember = true});
  const auto a = run(first), b = run(second);
  EXPECT_EQ(first.asked, second.asked);
  EXPECT_EQ(a.reason, b.reason);
}

TEST_P(OptimizerConformance, TakesAnotherCourseWithAnotherSeed) {
  if (!make()->needs().random) GTEST_SKIP() << "declares no randomness";
  FunctionProblem first(rosenbrock(3), {.budget = 20000, .seed = 5, .remember = true});
  FunctionProblem second(rosenbrock(3), {.budget = 20000, .seed = 6, .remember = true});
  run(first), run(second);
  EXPECT_TRUE(first.asked != second.asked);
}

TEST_P(OptimizerConformance, DoesNotDependOnTheOrderOfParallelWork) {
  FunctionProblem forwards(rastrigin(3), {.budget = 20000, .seed = 3});
  FunctionProblem backwards(rastrigin(3), {.budget = 20000, .seed = 3, .reverse = true});
  const auto a = run(forwards), b = run(backwards);
  EXPECT_EQ(forwards.best_point, backwards.best_point);
  EXPECT_EQ(forwards.evaluations(), backwards.evaluations());
  EXPECT_EQ(a.reason, b.reason);
}

TEST_P(OptimizerConformance, SurvivesThatThreeInTenEvaluationsFail) {
  // Which points fail is a hash of their bits and seed 11. A start of a local method gets ten or more trials to
  // halve its step, so that all of 20 starts failing to come within 1e-2 has a chance below 1e-9.
  FunctionProblem problem(sphere(3), {.budget = GetParam().budget, .seed = 11, .failure_rate = 0.3});
  run(problem);
  EXPECT_GT(problem.failures, 0u);
  EXPECT_LE(problem.best, 1e-2);
}

TEST_P(OptimizerConformance, EndsAndSaysWhyWhenNothingCanBeEvaluated) {
  FunctionProblem problem(sphere(3), {.budget = 1000000, .failure_rate = 2});
  const auto outcome = run(problem);
  EXPECT_FALSE(outcome.converged);
  EXPECT_LT(problem.evaluations(), 100000u) << "should give up";
  EXPECT_NE(outcome.reason.find("could be evaluated"), std::string::npos) << outcome.reason;
  EXPECT_NE(outcome.reason.find("the test double fails here"), std::string::npos) << outcome.reason;
}

TEST_P(OptimizerConformance, PrintsNothing) {
  FunctionProblem problem(sphere(3), {.budget = 5000, .failure_rate = 2});
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  run(problem);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_P(OptimizerConformance, PrefersFeasiblePoints) {
  FunctionProblem problem(half_sphere(), {.budget = GetParam().budget});
  run(problem);
  ASSERT_FALSE(problem.best_point.empty()) << "no feasible point was found";
  EXPECT_NEAR(problem.best, half_sphere().optimum, GetParam().boundary);
}

TEST_P(OptimizerConformance, ReachesAnOptimumOnTheBoundaryOfWhatIsFeasible) {
  for (const Function& function : {hock_schittkowski_65(), rosenbrock_in_disc(), limited_curve()}) {
    if (!GetParam().oblique && function.name != "hock_schittkowski_65") continue;
    FunctionProblem problem(function, {.budget = GetParam().budget});
    const auto outcome = run(problem);
    ASSERT_FALSE(problem.best_point.empty()) << function.name << ": no feasible point was found: " << outcome.reason;
    EXPECT_LE(problem.best, function.optimum * (1 + GetParam().boundary)) << function.name << ": " << outcome.reason;
    EXPECT_GE(problem.best, function.optimum * (1 - 1e-4)) << function.name << " has a wrong optimum";
  }
}

TEST_P(OptimizerConformance, IsNotMisledByObjectivesOfInfeasiblePointsThatLackCostlyTests) {
  if (make()->needs().infeasible) GTEST_SKIP() << "needs them in full and says so";
  FunctionProblem problem(hock_schittkowski_65(), {.budget = GetParam().budget, .partial = true});
  run(problem);
  ASSERT_FALSE(problem.best_point.empty()) << "no feasible point was found";
  EXPECT_LE(problem.best, hock_schittkowski_65().optimum * (1 + GetParam().boundary));
}

TEST_P(OptimizerConformance, SaysSoWhereNothingIsFeasible) {
  FunctionProblem problem(nothing_feasible(), {.budget = 20000});
  const auto outcome = run(problem);
  EXPECT_FALSE(outcome.converged);
  EXPECT_NE(outcome.reason.find("no feasible point"), std::string::npos) << outcome.reason;
  EXPECT_NEAR(problem.least_violation, 0.1, GetParam().boundary);
}

TEST_P(OptimizerConformance, StopsAtTheBudgetToTheEvaluation) {
  for (const std::uint64_t budget : {0u, 1u, 2u, 17u, 119u, 121u, 500u}) {
    FunctionProblem problem(rosenbrock(4), {.budget = budget, .failure_rate = 0.1});
    const auto outcome = run(problem);
    EXPECT_LE(problem.evaluations(), budget);
    if (!outcome.converged) {
      EXPECT_NE(outcome.reason.find("stopped"), std::string::npos) << budget << outcome.reason;
    }
  }
}

TEST_P(OptimizerConformance, StopsWhenTheTargetIsReached) {
  FunctionProblem problem(sphere(4), {.budget = GetParam().budget, .target = 1e-3});
  const auto outcome = run(problem);
  EXPECT_LE(problem.best, 1e-3);
  EXPECT_LT(problem.evaluations(), GetParam().budget);
  EXPECT_NE(outcome.reason.find("stopped"), std::string::npos) << outcome.reason;
}

}  // namespace tunica::testing
