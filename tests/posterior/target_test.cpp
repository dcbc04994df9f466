// SPDX-License-Identifier: Apache-2.0
#include "posterior/target.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "uncertainty/local.hpp"

using namespace tunica;
using posterior::Point;
using posterior::Target;

namespace {

/// ln p and its gradient against central differences, at a place away from the centre.
void expect_exact_gradient(const trial::Line& line, bool factor_known, bool discrepancy = false) {
  const auto assembly = line.assemble();
  Status status;
  const auto question = posterior::question_at(assembly, std::vector{1.0, 2.0}, {}, status, discrepancy);
  ASSERT_TRUE(question) << status.reason();
  EXPECT_EQ(question->factor_known, factor_known);
  const Eigen::Vector2d z(-1.1, 0.4);
  Point here, ahead, behind;
  Target plain(*question, 1.3);
  ASSERT_TRUE(plain.evaluate(z, here));
  Target target(*question, discrepancy ? plain.metric_at(here) : Target::Metric{1.3, {}});
  ASSERT_TRUE(target.evaluate(z, here));
  constexpr double step = 1e-5;
  for (Eigen::Index j = 0; j < 2; ++j) {
    ASSERT_TRUE(target.evaluate(z + step * Eigen::Vector2d::Unit(j), ahead));
    ASSERT_TRUE(target.evaluate(z - step * Eigen::Vector2d::Unit(j), behind));
    const double slope = (ahead.log_density - behind.log_density) / (2 * step);
    EXPECT_NEAR(here.gradient[j], slope, 1e-6 * (1 + std::abs(slope)));
    const Eigen::VectorXd slopes = (ahead.rows - behind.rows) / (2 * step);
    EXPECT_LT((here.slopes.col(j) - slopes).norm(), 1e-7 * slopes.norm());
  }
}

}  // namespace

TEST(PosteriorTarget, HasExactDerivativesWhereNoiseIsStated) {
  trial::Line line;
  line.experiment.tests.front().data.noise = {{"y", {0.1, 0.01, 0.4}}};
  line.parameter("b").prior = experiment::Prior{2.1, 0.2};
  expect_exact_gradient(line, true);
}

TEST(PosteriorTarget, HasExactDerivativesWhereTheFactorOfTheNoiseIsUnknown) {
  expect_exact_gradient(trial::Line(), false);
}

TEST(PosteriorTarget, HasExactDerivativesBesideADiscrepancy) {
  trial::Line line(30);
  expect_exact_gradient(line, false, true);
  line.experiment.tests.front().data.noise = {{"y", {0.1}}};
  line.parameter("b").prior = experiment::Prior{2.1, 0.2};
  expect_exact_gradient(line, true, true);
}

// ln p is −½ ‖H‖² + const where all noise is stated and priors are on a linear scale.
TEST(PosteriorTarget, IsASumOfSquaresOfItsRows) {
  trial::Line line;
  line.experiment.tests.front().data.noise = {{"y", {0.1}}};
  line.parameter("a").prior = experiment::Prior{1.2, 0.5};
  const auto assembly = line.assemble();
  Status status;
  const auto question = posterior::question_at(assembly, std::vector{1.0, 2.0}, {}, status);
  ASSERT_TRUE(question);
  Target target(*question, 1);
  Point point;
  for (const auto& z : {Eigen::Vector2d(0, 0), Eigen::Vector2d(-1, 0.5)}) {
    ASSERT_TRUE(target.evaluate(z, point));
    EXPECT_NEAR(point.log_density, -0.5 * point.rows.squaredNorm(), 1e-9 * point.rows.squaredNorm());
  }
}

TEST(PosteriorTarget, GoesToCoordinatesAndBack) {
  const trial::Line line;
  const auto assembly = line.assemble();
  Status status;
  const auto question = posterior::question_at(assembly, std::vector{1.0, 2.0}, {}, status);
  ASSERT_TRUE(question);
  const Target target(*question, 1);
  const auto free = target.free(target.coordinates(std::vector{3.5, 0.7}));
  EXPECT_NEAR(free[0], 3.5, 1e-12);
  EXPECT_NEAR(free[1], 0.7, 1e-12);
  // A point at a bound has finite coordinates, a hair's breadth inside.
  const auto inside = target.free(target.coordinates(std::vector{0.0, 10.0}));
  EXPECT_GT(inside[0], 0);
  EXPECT_LT(inside[0], 1e-10);
  EXPECT_LE(inside[1], 10);
}
