// SPDX-License-Identifier: Apache-2.0
#include "assembly/restricted_variance.hpp"

#include <cmath>
#include <random>

#include <Eigen/QR>
#include <gmock/gmock.h>

#include "assembly/growing_noise.hpp"

namespace tunica::assembly {
namespace {

using ::testing::ElementsAre;

/// 1, x, x² … over rows of which the first `count[0]` are group 0, the next group 1, and so on; x from −1 to 1 in each.
VarianceProblem polynomials(const std::vector<std::size_t>& count, Eigen::Index degree) {
  VarianceProblem problem;
  for (std::size_t g = 0; g < count.size(); ++g) problem.group.insert(problem.group.end(), count[g], g);
  const auto n = static_cast<Eigen::Index>(problem.group.size());
  problem.columns = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(count.size()) * (degree + 1));
  problem.residuals = Eigen::VectorXd::Zero(n);
  problem.shape = Eigen::VectorXd::Ones(n);
  Eigen::Index row = 0;
  for (std::size_t g = 0; g < count.size(); ++g)
    for (std::size_t i = 0; i < count[g]; ++i, ++row)
      for (Eigen::Index d = 0; d <= degree; ++d)
        problem.columns(row, static_cast<Eigen::Index>(g) * (degree + 1) + d) =
            std::pow(2.0 * static_cast<double>(i) / static_cast<double>(count[g] - 1) - 1, static_cast<double>(d));
  return problem;
}

Eigen::VectorXd white(Eigen::Index n, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(n, [&] { return normal(generator); });
}

// Each group with columns of its own: the textbook's RSS/(n − k).
TEST(RestrictedVariance, IsTheResidualMeanSquareOfSeparateRegressions) {
  std::mt19937_64 generator(1);
  VarianceProblem problem = polynomials({20, 12}, 2);
  problem.residuals = white(32, generator);
  problem.residuals.tail(12) *= 5;
  const RestrictedVariance found = restricted_variance(problem);
  for (const auto& [g, first, n] : {std::tuple{0, 0, 20}, {1, 20, 12}}) {
    const Eigen::MatrixXd X = problem.columns.block(first, 3 * g, n, 3);
    const Eigen::VectorXd y = problem.residuals.segment(first, n);
    const double squares = (y - X * X.householderQr().solve(y)).squaredNorm();
    EXPECT_NEAR(found.variance[static_cast<std::size_t>(g)], squares / (n - 3), 1e-9 * squares);
    EXPECT_NEAR(found.freedom[static_cast<std::size_t>(g)], n - 3, 1e-9);
  }
}

// Seed 2, 2000 data sets: two groups share a slope, σ = 1 and 3. The mean of σ̂²/σ² has a standard deviation of
// √(2/(ν·2000)); four of them, false alarm 2 · 6e-5. Twenty rows of unbiased pieces would be 30 % too small
// uncorrected.
TEST(RestrictedVariance, IsUnbiasedWhereGroupsShareColumns) {
  std::mt19937_64 generator(2);
  VarianceProblem problem = polynomials({14, 20}, 4);
  const Eigen::MatrixXd shared = problem.columns.leftCols(5) + problem.columns.rightCols(5);
  problem.columns.resize(34, 6);
  problem.columns << shared, Eigen::VectorXd::LinSpaced(34, -1, 1).array().sin().matrix();
  double first = 0, second = 0, freedom = 0;
  constexpr int sets = 2000;
  for (int k = 0; k < sets; ++k) {
    problem.residuals = white(34, generator);
    problem.residuals.tail(20) *= 3;
    const RestrictedVariance found = restricted_variance(problem);
    first += found.variance[0];
    second += found.variance[1] / 9;
    freedom += found.freedom[0];
    EXPECT_NEAR(found.freedom[0] + found.freedom[1], 28, 1e-6);
  }
  freedom /= sets;
  EXPECT_NEAR(first / sets, 1, 4 * std::sqrt(2 / (freedom * sets)));
  EXPECT_NEAR(second / sets, 1, 4 * std::sqrt(2 / ((28 - freedom) * sets)));
}

TEST(RestrictedVariance, LeavesKnownVarianceAndTheLeastAlone) {
  VarianceProblem problem = polynomials({10, 10}, 1);
  std::fill_n(problem.group.begin(), 10, known_variance);
  std::fill_n(problem.group.begin() + 10, 10, 0);
  problem.least = {0.25};
  const RestrictedVariance found = restricted_variance(problem);  // residuals of 0
  ASSERT_EQ(found.variance.size(), 1u);
  EXPECT_EQ(found.variance[0], 0.25);
  EXPECT_TRUE(found.at_least[0]);
}

// Seed 3: σ from 1 to √(1 + 9) over three curves of 40 rows: a likelihood gain of about 60. And white noise, 400 times:
// with no share as likely before as any, half a variance is taken for relative where the likelihood gains 2 · ln 2 or
// so, one-sided 14 %; families of their own ask for a gain of 4, 2.3 % each. Bound: four standard deviations above 400
// · 0.19.
TEST(GrowingNoise, IsSeenWhereItIsAndSeldomElsewhere) {
  std::mt19937_64 generator(3);
  VarianceProblem problem = polynomials({40, 40, 40}, 3);
  const Eigen::VectorXd level = problem.columns.col(1) + problem.columns.col(5) + problem.columns.col(9);
  const Eigen::VectorXd growing = (1 + 9 * level.array().square()).sqrt();
  problem.residuals = white(120, generator).cwiseProduct(growing);
  VarianceProblem fitted = problem;
  const std::vector<double> shares = growing_noise(fitted, {0, 0, 0}, level).share;
  ASSERT_EQ(shares.size(), 1u);
  EXPECT_GE(shares[0], 4);
  EXPECT_LE(shares[0], 30);
  EXPECT_NEAR(fitted.shape[0], 1 + shares[0] * level[0] * level[0], 1e-9);
  int claimed = 0;
  for (int k = 0; k < 400; ++k) {
    fitted = problem;
    fitted.residuals = white(120, generator);
    const std::vector<double> none = growing_noise(fitted, {0, 1, 1}, level).share;
    claimed += std::max(none[0], none[1]) >= 1;
  }
  EXPECT_LE(claimed, 400 * 0.19 + 4 * std::sqrt(400 * 0.19));
}

TEST(ValueStep, IsFoundWhereValuesAreRounded) {
  std::vector<double> values;
  for (int i = 0; i < 40; ++i) values.push_back(0.25 * std::round(3 * std::sin(0.3 * i) / 0.25));
  EXPECT_NEAR(value_step(values), 0.25, 1e-9);
  for (double& value : values) value += 0.01 * std::sin(7 * value + value * value);
  EXPECT_EQ(value_step(values), 0);
  EXPECT_EQ(value_step(std::vector<double>(10, 3.0)), 0);
}

}  // namespace
}  // namespace tunica::assembly
