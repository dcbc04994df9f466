// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "conformance/functions.hpp"
#include "optimizers/lamb_aorta.hpp"
#include "optimizers/plugin_under_test.hpp"

namespace tunica::testing {
using namespace conformance;
namespace {

Given one_start() { return {{"starts", std::int64_t{1}}}; }

TEST(CeresLm, SolvesLinearResidualsInAFewEvaluations) {
  FunctionProblem problem(ellipsoid(5), {});
  const auto outcome = make_optimizer("ceres_lm", one_start())->minimise(problem);
  EXPECT_TRUE(outcome.converged) << outcome.reason;
  EXPECT_LE(problem.best, 1e-10);
  EXPECT_LE(problem.evaluations(), 20u);
}

TEST(CeresLm, TakesTheJacobianAlongWithEveryEvaluationAndAsksForNoPointTwice) {
  FunctionProblem problem(rosenbrock(2), {.remember = true});
  make_optimizer("ceres_lm", one_start())->minimise(problem);
  EXPECT_EQ(problem.jacobians, problem.evaluations());
  for (std::size_t i = 2; i + 1 < problem.asked.size(); i += 2) {
    EXPECT_FALSE(problem.asked[i] == problem.asked[i - 2] && problem.asked[i + 1] == problem.asked[i - 1]) << i / 2;
  }
}

/// Least of |A (x − c)|² over the unit box, face by face.
double least_in_box(const Eigen::Matrix4d& A, const Eigen::Vector4d& c) {
  double least = std::numeric_limits<double>::infinity();
  for (int face = 0; face < 81; ++face) {
    Eigen::Vector4d x = Eigen::Vector4d::Zero();
    std::vector<int> free;
    for (int j = 0, code = face; j < 4; ++j, code /= 3) {
      if (code % 3 == 0) free.push_back(j);
      if (code % 3 == 2) x[j] = 1;
    }
    if (!free.empty()) {
      const Eigen::VectorXd inside = A(Eigen::all, free).colPivHouseholderQr().solve(A * (c - x));
      for (std::size_t k = 0; k < free.size(); ++k) x[free[k]] = inside[static_cast<Eigen::Index>(k)];
    }
    if ((x.array() < 0).any() || (x.array() > 1).any()) continue;
    least = std::min(least, (A * (x - c)).squaredNorm());
  }
  return least;
}

/// Valleys that lead out of the box (seed 3, deterministic: no false alarm).
TEST(CeresLm, EndsAtTheOptimumWhereBoundsAreActive) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(-0.5, 1.5);
  for (int draw = 0; draw < 50; ++draw) {
    const Eigen::Matrix4d random = Eigen::Matrix4d::NullaryExpr([&] { return normal(engine); });
    const Eigen::JacobiSVD<Eigen::Matrix4d> parts(random, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Vector4d narrow{1, 0.1, 0.01, 0.003};
    const Eigen::Matrix4d A = parts.matrixU() * narrow.asDiagonal() * parts.matrixV().transpose();
    const Eigen::Vector4d c = Eigen::Vector4d::NullaryExpr([&] { return unit(engine); });
    const double least = least_in_box(A, c);
    Function function;
    function.name = "valley";
    function.dimension = 4;
    function.residual_count = 4;
    function.blocks = {{0, 4, 1, ResidualBlock::Loss::quadratic}};
    function.start = {0.5, 0.5, 0.5, 0.5};
    function.residuals = [&](std::span<const double> x, std::span<double> r, std::span<double> jacobian) {
      const Eigen::Vector4d value = A * (Eigen::Map<const Eigen::Vector4d>(x.data()) - c);
      std::ranges::copy(value, r.begin());
      for (std::size_t i = 0; i < jacobian.size(); ++i)
        jacobian[i] = A(static_cast<int>(i) / 4, static_cast<int>(i) % 4);
      return true;
    };
    FunctionProblem problem(function, {});
    make_optimizer("ceres_lm", one_start())->minimise(problem);
    EXPECT_LE(problem.best, least * (1 + 1e-6) + 1e-12) << draw;
  }
}

TEST(CeresLm, ReplacesStartsThatCannotBeEvaluated) {
  // The start, and 9 in 10 of all points, fail at first sight: only y_0 < −1.5 can be evaluated.
  Function function = sphere(2);
  function.start = {0.9, 0.5};
  function.residuals = [inner = function.residuals](std::span<const double> x, std::span<double> r,
                                                    std::span<double> jacobian) {
    return x[0] < 0.1 && inner(x, r, jacobian);
  };
  FunctionProblem problem(function, {});
  const auto outcome = make_optimizer("ceres_lm")->minimise(problem);
  EXPECT_LT(problem.best, std::numeric_limits<double>::infinity()) << outcome.reason;
  EXPECT_NE(outcome.reason.find("of 20 starts could be evaluated"), std::string::npos) << outcome.reason;
}

TEST(CeresLm, WeighsQuadraticAndRootBlocksAsTheObjectiveDoes) {
  // 3 (y − 1)² + 2 |y − 2| on [−2, 3]: zero slope at 6 (y − 1) = 2, y = 4/3, objective 1/3 + 4/3.
  Function function =
      least_squares("mixed", 1, 2, -2, 3, [](const auto& y, std::span<double> r, std::span<double> jacobian) {
        r[0] = y[0] - 1;
        r[1] = y[0] - 2;
        std::fill(jacobian.begin(), jacobian.end(), 1.0);
      });
  function.blocks = {{0, 1, 3, ResidualBlock::Loss::quadratic}, {1, 1, 2, ResidualBlock::Loss::root}};
  FunctionProblem problem(function, {});
  make_optimizer("ceres_lm", one_start())->minimise(problem);
  EXPECT_NEAR(problem.best, 5.0 / 3, 1e-8);
  EXPECT_NEAR(problem.best_point[0], (4.0 / 3 + 2) / 5, 1e-4);
}

TEST(CeresLm, SolvesSumOfNormsWithAPerfectFit) {
  // The root is not differentiable where the residuals vanish, which is where noise-free data lead.
  Function function = rosenbrock(3);
  function.blocks = {{0, 2, 1, ResidualBlock::Loss::root}, {2, 2, 1, ResidualBlock::Loss::root}};
  FunctionProblem problem(function, {});
  make_optimizer("ceres_lm")->minimise(problem);
  EXPECT_LE(problem.best, 1e-6);
}

TEST(CeresLm, ScreeningSavesEvaluations) {
  FunctionProblem all(rosenbrock(4), {}), screened(rosenbrock(4), {});
  make_optimizer("ceres_lm")->minimise(all);
  make_optimizer("ceres_lm", {{"screening_iterations", std::int64_t{8}}, {"polished", std::int64_t{3}}})
      ->minimise(screened);
  EXPECT_LE(screened.best, 1e-8);
  EXPECT_LT(screened.evaluations(), all.evaluations());
}

TEST(CeresLm, CountsTheStartsThatAgree) {
  // At an optimum of 0 "the same objective" is never met relatively, so the sphere stands on a residual of 1.
  Function function =
      least_squares("raised", 1, 2, -2, 3, [](const auto& y, std::span<double> r, std::span<double> jacobian) {
        r[0] = y[0];
        r[1] = 1;
        if (!jacobian.empty()) jacobian[0] = 1;
      });
  FunctionProblem raised(function, {});
  const auto outcome = make_optimizer("ceres_lm", {{"starts", std::int64_t{4}}})->minimise(raised);
  EXPECT_TRUE(outcome.reason.starts_with("4 of 4 starts could be evaluated, 4 came to the best objective; "))
      << outcome.reason;
}

TEST(CeresLm, ReachesTheOptimumOfTheLambAortaFromEverySeed) {
  // A start succeeds with probability 0.7 (0.5 where inadmissible dispersion fails): 20 starts all failing has a
  // chance below 1e-6. Seeds 1 to 20; the problem's start is in the middle of the box.
  for (const bool strict : {false, true}) {
    const auto function = lamb_aorta(strict);
    ASSERT_TRUE(function) << "examples/lamb_aorta has lost its strips";
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      FunctionProblem problem(*function, {.budget = 2000, .seed = seed});
      const auto outcome = make_optimizer("ceres_lm")->minimise(problem);
      EXPECT_LE(problem.best, 66.101) << "seed " << seed << ": " << outcome.reason;
    }
  }
}

TEST(CeresLm, CountsTheStartsThatWereMadeBeforeTheEnd) {
  FunctionProblem problem(rosenbrock(2), {.budget = 40});
  const auto outcome = make_optimizer("ceres_lm", {{"starts", std::int64_t{20}}})->minimise(problem);
  EXPECT_NE(outcome.reason.find(" starts (of 20) made until then could be evaluated"), std::string::npos)
      << outcome.reason;
}

}  // namespace
}  // namespace tunica::testing
