// SPDX-License-Identifier: Apache-2.0
#include "population/population.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "numerics/distributions.hpp"
#include "population/simulated.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using namespace tunica::population;

namespace {

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }
Eigen::MatrixXd precise(double value) { return Eigen::MatrixXd::Constant(1, 1, value); }

/// n values around 3 with a spread of 0.5, seed 1.
std::vector<Eigen::VectorXd> values(std::size_t n) {
  simulated::Normal normal(1);
  std::vector<Eigen::VectorXd> result;
  for (std::size_t i = 0; i < n; ++i) result.push_back(one(3 + 0.5 * normal()));
  return result;
}

std::vector<Eigen::VectorXd> strips(std::size_t n, double spread, simulated::Normal& normal) {
  std::vector<Eigen::VectorXd> result;
  for (std::size_t i = 0; i < n; ++i) result.push_back(simulated::strip().typical + spread * normal.vector(3));
  return result;
}

void expect_same_bits(const Population& a, const Population& b) {
  EXPECT_EQ(a.beta, b.beta);
  EXPECT_EQ(a.beta_covariance, b.beta_covariance);
  EXPECT_EQ(a.omega, b.omega);
  EXPECT_EQ(a.noise, b.noise);
  EXPECT_EQ(a.ml->deviance, b.ml->deviance);
  for (std::size_t k = 0; k < a.spreads.size(); ++k)
    EXPECT_EQ(a.spreads[k].interval.upper, b.spreads[k].interval.upper);
}

}  // namespace

TEST(Population, OfExactValuesIsSampleMeanAndVarianceWithStudentsInterval) {
  const auto xs = values(9);
  const Population found = estimate(simulated::linear(xs, {9, precise(1e10)}));
  double mean = 0, variance = 0;
  for (const auto& x : xs) mean += x[0] / 9;
  for (const auto& x : xs) variance += (x[0] - mean) * (x[0] - mean) / 8;
  EXPECT_NEAR(found.beta[0], mean, 1e-8);
  EXPECT_NEAR(found.omega(0, 0), variance, 1e-6);
  EXPECT_EQ(found.coefficients[0].freedom, 8);
  const double reach = numerics::student_quantile(0.975, 8) * std::sqrt(variance / 9);
  EXPECT_NEAR(found.coefficients[0].interval.upper - mean, reach, 1e-6);
  EXPECT_NEAR(found.borrowed[0], 0, 1e-8);
}

// (n − 1)(v̂/v − 1 − log(v̂/v)) is the restricted deviance of a variance.
TEST(Population, ProfileOfASpreadIsTheClosedFormOfExactValues) {
  const Population found = estimate(simulated::linear(values(9), {9, precise(1e10)}));
  const double variance = found.omega(0, 0), level = numerics::chi_squared_quantile(0.95, 1);
  for (const double end : {found.spreads[0].interval.lower, found.spreads[0].interval.upper}) {
    const double ratio = variance / (end * end);
    EXPECT_NEAR(8 * (ratio - 1 - std::log(ratio)), level, 2e-3);
  }
}

// Balanced one-way analysis of variance: the restricted estimate is (MS_between − MS_within)/m where positive. S.
// Searle, G. Casella, C. McCulloch, Variance Components (1992), section 3.8.
TEST(Population, NestedBalancedIsTheAnalysisOfVariance) {
  simulated::Normal normal(7);
  constexpr std::size_t animals = 6, each = 4;
  std::vector<Eigen::VectorXd> xs;
  std::vector<double> means(animals, 0.0);
  for (std::size_t k = 0; k < animals; ++k) {
    const double a = 0.8 * normal();
    for (std::size_t i = 0; i < each; ++i) {
      xs.push_back(one(2 + a + 0.4 * normal()));
      means[k] += xs.back()[0] / each;
    }
  }
  Cohort cohort = simulated::linear(xs, {animals * each, precise(1e10)});
  for (std::size_t k = 0; k < animals; ++k) cohort.animals.push_back("animal " + std::to_string(k));
  for (std::size_t i = 0; i < xs.size(); ++i) cohort.specimens[i].animal = i / each;
  const Population found = estimate(cohort);
  double mean = 0, between = 0, within = 0;
  for (const double own : means) mean += own / animals;
  for (const double own : means) between += each * (own - mean) * (own - mean) / (animals - 1);
  for (std::size_t i = 0; i < xs.size(); ++i)
    within += (xs[i][0] - means[i / each]) * (xs[i][0] - means[i / each]) / (animals * (each - 1));
  ASSERT_GT(between, within);
  EXPECT_NEAR(found.omega(0, 0), within, 1e-5 * within);
  EXPECT_NEAR(found.omega_between(0, 0), (between - within) / each, 1e-5 * within);
  EXPECT_NEAR(found.coefficients[0].standard_error, std::sqrt(between / (animals * each)), 1e-6);
  EXPECT_EQ(found.coefficients[0].freedom, animals - 1);
}

// Six specimens fix p0 + p1 only and six fix p1 only: every A is singular. The marginal covariance of what a specimen
// fixes is uᵀΩu, so that generalised least squares can be written down by hand.
TEST(Population, SingularInformationGivesGeneralisedLeastSquares) {
  simulated::Normal normal(3);
  std::vector<Eigen::VectorXd> xs;
  std::vector<Eigen::MatrixXd> As;
  const Eigen::Vector2d sum(1, 1), second(0, 1);
  for (std::size_t i = 0; i < 12; ++i) {
    xs.push_back(Eigen::Vector2d(1, -2) + Eigen::Vector2d(0.5 * normal(), 0.3 * normal()));
    const Eigen::Vector2d u = i < 6 ? sum : second;
    As.push_back(4.0 * u * u.transpose());
  }
  const Population found = estimate(simulated::linear(xs, As));
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < 12; ++i) {
    const Eigen::Vector2d u = i < 6 ? sum : second;
    const double weight = 1 / (0.25 + u.dot(found.omega * u));
    H += weight * u * u.transpose();
    b += weight * u * u.dot(xs[i]);
  }
  EXPECT_TRUE(found.beta.isApprox(H.ldlt().solve(b), 1e-9));
  EXPECT_TRUE(found.beta_covariance.isApprox(H.inverse(), 1e-9));
}

TEST(Population, ASpreadOfZeroIsSaidToBeAtTheBoundary) {
  // Values nearer to each other than their own errors would scatter them.
  std::vector<Eigen::VectorXd> xs;
  for (int i = 0; i < 8; ++i) xs.push_back(one(1 + 0.01 * i));
  const Population found = estimate(simulated::linear(xs, {8, precise(1)}));
  EXPECT_TRUE(found.spreads[0].at_zero);
  EXPECT_EQ(found.omega(0, 0), 0);
  EXPECT_EQ(found.spreads[0].interval.lower, 0);
  EXPECT_GT(found.spreads[0].interval.upper, 0.1);
  EXPECT_EQ(found.borrowed[0], 1);
  EXPECT_NEAR(found.coefficients[0].standard_error, std::sqrt(1.0 / 8), 1e-9);
}

TEST(Population, TwoSpecimensHaveOneDegreeOfFreedom) {
  const Population found = estimate(simulated::linear({one(1), one(2)}, {2, precise(1e8)}));
  EXPECT_NEAR(found.beta[0], 1.5, 1e-9);
  EXPECT_NEAR(found.omega(0, 0), 0.5, 1e-5);
  EXPECT_EQ(found.coefficients[0].freedom, 1);
  EXPECT_NEAR(found.coefficients[0].interval.upper - 1.5, 0.5 * std::tan(M_PI * 0.475), 1e-4);  // Cauchy
}

TEST(Population, TakesTheShapeThatTheSpecimensCarry) {
  simulated::Normal normal(5);
  for (const auto& [n, shape] : {std::pair(8, Shape::diagonal), std::pair(20, Shape::full)}) {
    const Population found =
        estimate(simulated::cohort(simulated::strip(), strips(static_cast<std::size_t>(n), 0.3, normal), normal));
    EXPECT_EQ(found.within.shape, shape);
    EXPECT_TRUE(found.converged);
  }
}

TEST(Population, IsTheSameBitsInAnyOrderAndWithAnyThreads) {
  simulated::Normal normal(11);
  Cohort cohort = simulated::cohort(simulated::strip(), strips(7, 0.3, normal), normal);
  cohort.animals = {"x", "y", "z"};
  for (std::size_t i = 0; i < 7; ++i) cohort.specimens[i].animal = i % 3;
  const Population found = estimate(cohort);
  Cohort turned = cohort;
  turned.animals = {"z", "y", "x"};
  for (std::size_t i = 0; i < 7; ++i) {
    turned.specimens[i] = cohort.specimens[6 - i];
    turned.specimens[i].animal = 2 - turned.specimens[i].animal;
  }
  turned.expand = [expand = cohort.expand](std::size_t i, const Prior& prior) { return expand(6 - i, prior); };
  turned.misfits = [misfits = cohort.misfits](std::size_t i, const Eigen::MatrixXd& points,
                                              const std::vector<double>& variances) {
    return misfits(6 - i, points, variances);
  };
  const Population again = estimate(turned);
  expect_same_bits(found, again);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(found.individuals[i].mean, again.individuals[6 - i].mean);
  EXPECT_EQ(found.animals[0], again.animals[2]);
  const oneapi::tbb::global_control serial(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  expect_same_bits(found, estimate(cohort));
}

TEST(Population, RefusesWhatItCannotEstimate) {
  const auto message = [](const Cohort& cohort, const Options& options = {}) {
    try {
      estimate(cohort, options);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message(simulated::linear({one(1)}, {precise(1)})).find("two specimens at least, found 1"),
            std::string::npos);
  Cohort cohort = simulated::linear(values(4), {4, precise(1)});
  cohort.specimens[2].name = cohort.specimens[1].name;
  EXPECT_NE(message(cohort).find("is there twice"), std::string::npos);
  cohort = simulated::linear(values(4), {4, precise(1)});
  cohort.factors = {{"treatment", {"no", "yes"}}};
  for (auto& specimen : cohort.specimens) specimen.levels = {0};
  EXPECT_NE(message(cohort).find("all 4 specimens have one level"), std::string::npos);
  cohort.factors.push_back({"sex", {"f", "m"}});
  for (std::size_t i = 0; i < 4; ++i) cohort.specimens[i].levels = {i % 2, i % 2};
  EXPECT_NE(message(cohort, {.factors = {0, 1}}).find("sort the 4 specimens alike"), std::string::npos);
  const Eigen::MatrixXd first = Eigen::Vector2d(1, 0) * Eigen::RowVector2d(1, 0);
  EXPECT_NE(message(simulated::linear({4, Eigen::Vector2d(1, 2)}, {4, first})).find("do not fix 'p1'"),
            std::string::npos);
}
