// SPDX-License-Identifier: Apache-2.0
#include <ctime>

#include <gtest/gtest.h>

#include "conformance/constrained_functions.hpp"
#include "conformance/g_suite.hpp"
#include "optimizers/allocations.hpp"
#include "optimizers/lamb_aorta.hpp"
#include "optimizers/plugin_under_test.hpp"

namespace tunica::testing {
using namespace conformance;
namespace {

TEST(Es, RefusesCommaSelectionWithoutSurplusOffspring) {
  try {
    make_optimizer("es", {{"selection", "comma"}, {"offspring", std::int64_t{10}}});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "'offspring' is 10 and 'parents' 10: with 'selection' \"comma\" the parents are chosen among the "
                 "offspring, so there must be more of these; about four times as many is usual");
  }
}

TEST(Es, RefusesCumulativeStepsWithoutAMeanToFollow) {
  for (const Given& given : {Given{{"recombination", "none"}}, Given{{"adaptation", "axes"}}}) {
    Given all = given;
    all.emplace_back("step_control", "cumulative");
    try {
      make_optimizer("es", all);
      FAIL() << "accepted";
    } catch (const InputError& error) {
      EXPECT_STREQ(
          error.what(),
          "'step_control' \"cumulative\" follows the mean of the parents: it needs 'adaptation' \"covariance\" "
          "and 'recombination' \"global\"; choose these, or \"automatic\"");
    }
  }
}

TEST(Es, MeetsActiveConstraintsToOneInTenThousand) {
  // Two to six constraints active at the optimum; 10 of 10 seeds each when this was written, so that with 95 %
  // confidence a fresh seed fails with a probability below 0.26; these are fixed.
  for (const GProblem& g : g_suite()) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      FunctionProblem problem(g_function(g), {.budget = 60000, .seed = seed});
      const auto outcome = make_optimizer("es")->minimise(problem);
      EXPECT_LE(problem.best - g.offset, g.optimum + 1e-4 * std::abs(g.optimum)) << g.name << " " << outcome.reason;
    }
  }
}

TEST(Es, RanksInfeasiblePointsByTheirViolation) {
  // Where the objective falls away from what is feasible, an order by objective never comes near it.
  Function function = constrained(sphere(2), 1, -2, 3, [](const auto& y, std::span<double> c, std::span<double>) {
    c[0] = std::hypot(y[0] - 2.9, y[1] - 2.9) - 1e-3;
  });
  FunctionProblem ranked(function, {.budget = 4000});
  FunctionProblem penalised(function, {.budget = 4000});
  make_optimizer("es")->minimise(ranked);
  make_optimizer("es", {{"infeasible", "constant_penalty"}})->minimise(penalised);
  EXPECT_FALSE(ranked.best_point.empty());
  EXPECT_TRUE(penalised.best_point.empty());
}

TEST(Es, EvaluatesTheStartFirst) {
  FunctionProblem problem(sphere(3), {.budget = 200, .remember = true});
  make_optimizer("es")->minimise(problem);
  EXPECT_EQ(std::vector<double>(problem.asked.begin(), problem.asked.begin() + 3), sphere(3).start);
}

TEST(Es, AllocatesNothingInItsGenerations) {
  const auto count = [](std::uint64_t budget) {
    FunctionProblem problem(rosenbrock(6), {.budget = budget});
    const auto optimizer = make_optimizer("es", {{"restarts", std::int64_t{0}}});
    const std::uint64_t before = allocations();
    optimizer->minimise(problem);
    return allocations() - before;
  };
  const std::uint64_t few = count(1200);
  EXPECT_GT(few, 0u) << "the plugin's allocations are not seen here";
  EXPECT_EQ(few, count(6000));
}

TEST(Es, CostsLittleBesideTheEvaluations) {
  FunctionProblem problem(sphere(6), {.budget = 120000});
  const auto optimizer = make_optimizer("es", {{"restarts", std::int64_t{1000}}});
  const std::clock_t begin = std::clock();  // processor time: other work on the machine does not count
  optimizer->minimise(problem);
  const double microseconds = 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / 120000;
  RecordProperty("microseconds_per_evaluation", std::to_string(microseconds));
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  // 0.2 µs in a release build, the sphere included.
  EXPECT_LE(microseconds, 2);
#endif
}

TEST(Es, RestartsUntilTheyAreExhausted) {
  FunctionProblem problem(sphere(2), {});
  const auto outcome = make_optimizer("es", {{"restarts", std::int64_t{2}}})->minimise(problem);
  EXPECT_TRUE(outcome.converged);
  EXPECT_TRUE(outcome.reason.starts_with("all 3 searches ended; the one that found the best point: "))
      << outcome.reason;
}

TEST(Es, SaysThatTheBestSearchHadConvergedWhenItIsStoppedLater) {
  FunctionProblem problem(sphere(2), {.budget = 20000});
  const auto outcome = make_optimizer("es", {{"restarts", std::int64_t{1000}}})->minimise(problem);
  EXPECT_TRUE(outcome.reason.starts_with("stopped in search ")) << outcome.reason;
  EXPECT_EQ(problem.evaluations(), 20000u);
}

TEST(Es, GrowingRestartsLeaveTheLocalMinimaOfRastrigin) {
  // 19 of 20 seeds within 100 000 evaluations when this was written; of three seeds one at least is expected to
  // succeed, false alarm 2e-4 for a fresh choice of seeds (these are fixed).
  int solved = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    FunctionProblem problem(rastrigin(6), {.budget = 100000, .seed = seed, .target = 1e-8});
    make_optimizer("es", {{"restart_growth", 2.0}})->minimise(problem);
    solved += problem.best <= 1e-8;
  }
  EXPECT_GE(solved, 1);
}

TEST(Es, FollowsTheValleyOfTheLambAorta) {
  const auto function = lamb_aorta();
  ASSERT_TRUE(function) << "examples/lamb_aorta has lost its strips";
  // 100 of 100 seeds reached 66.101 when this was written, the slowest after 10 703 evaluations. With 97 % or more
  // (95 % confidence) a fresh set of 20 seeds would have a chance of 0.45 or less of one failure; these are fixed.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    FunctionProblem problem(*function, {.budget = 30000, .seed = seed, .target = 66.101});
    const auto outcome = make_optimizer("es")->minimise(problem);
    EXPECT_LE(problem.best, 66.101) << "seed " << seed << ": " << outcome.reason;
  }
}

TEST(Es, DoesNotFollowItWithUncorrelatedSteps) {
  const auto function = lamb_aorta();
  ASSERT_TRUE(function) << "examples/lamb_aorta has lost its strips";
  // Why covariance is the default: 0 of 20 seeds when this was written.
  FunctionProblem problem(*function, {.budget = 10000, .target = 66.101});
  make_optimizer("es", {{"adaptation", "axes"}})->minimise(problem);
  EXPECT_GT(problem.best, 66.101);
}

}  // namespace
}  // namespace tunica::testing
