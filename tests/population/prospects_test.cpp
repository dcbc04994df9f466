// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "numerics/distributions.hpp"
#include "population/outliers.hpp"
#include "population/power.hpp"
#include "population/predictive.hpp"
#include "population/simulated.hpp"

using namespace tunica;
using namespace tunica::population;

namespace {

Cohort exact_normal(std::size_t n, std::size_t p, simulated::Normal& normal) {
  std::vector<Eigen::VectorXd> xi;
  for (std::size_t i = 0; i < n; ++i) xi.push_back(normal.vector(static_cast<Eigen::Index>(p)));
  const auto size = static_cast<Eigen::Index>(p);
  return simulated::linear(xi, {n, 1e8 * Eigen::MatrixXd::Identity(size, size)});
}

Options quick() {
  Options options;
  options.intervals_of_spreads = options.maximum_likelihood = false;
  return options;
}

}  // namespace

// J. Cohen (1988), table 2.4.1: 64 members a group show d = 0.5 with 80 % at 5 %, 26 show d = 0.8, 17 show d = 1.
TEST(Power, NeedsTheNumbersOfCohensTable) {
  EXPECT_EQ(needed(1, 0.5), 64u);
  EXPECT_EQ(needed(1, 0.8), 26u);
  EXPECT_EQ(needed(2, 2), 17u);
  EXPECT_NEAR(power_of(1, 0, 8), 0.05, 1e-9);
  EXPECT_FALSE(needed(1, 1e-4));
}

TEST(Power, DetectableIsWhereThePowerIsReached) {
  const double least = detectable(0.3, 8);
  EXPECT_NEAR(power_of(0.3, least, 8), 0.8, 1e-6);
  EXPECT_GT(least, 0.3);
}

TEST(Power, CountsTheErrorsOfSpecimensBesideTheirSpread) {
  std::vector<Eigen::VectorXd> xi;
  for (int i = 0; i < 10; ++i) xi.push_back(Eigen::VectorXd::Constant(1, 0.4 * (i % 5)));
  const Population found = estimate(simulated::linear(xi, {10, Eigen::MatrixXd::Constant(1, 1, 25)}), quick());
  EXPECT_NEAR(deviations(found)[0].deviation, std::sqrt(found.omega(0, 0) + 1.0 / 25), 1e-9);
}

TEST(Predictive, CoversANewSpecimenAsStudentsPredictionIntervalDoes) {
  simulated::Normal normal(2);
  const Population found = estimate(exact_normal(7, 1, normal), quick());
  const Predictive next = predictive(found, {});
  EXPECT_NEAR(next.covariance(0, 0), found.omega(0, 0) * (1 + 1.0 / 7), 1e-6);
  // 20 000 draws: the share beyond Student's 97.5 % point lies within 0.025 ± 0.0045 with probability 0.99995.
  const Eigen::MatrixXd drawn = draws(next, 5, 20000);
  const double edge = next.mean[0] + numerics::student_quantile(0.975, 6) * std::sqrt(next.covariance(0, 0));
  EXPECT_NEAR((drawn.row(0).array() > edge).cast<double>().mean(), 0.025, 0.0045);
  EXPECT_EQ(drawn.leftCols(3), draws(next, 5, 3));
}

TEST(Outliers, OneAmongExactValuesHasTheDeletedStudentResidual) {
  simulated::Normal normal(9);
  Cohort cohort = exact_normal(8, 1, normal);
  std::vector<double> values;
  for (std::size_t i = 0; i < 8; ++i) values.push_back(estimate(cohort, quick()).individuals[i].mean[0]);
  const auto standings = outliers(cohort, estimate(cohort, quick()));
  ASSERT_EQ(standings.size(), 8u);
  for (const Standing& standing : standings) {
    double mean = 0, variance = 0;
    for (std::size_t i = 0; i < 8; ++i)
      if (i != standing.specimen) mean += values[i] / 7;
    for (std::size_t i = 0; i < 8; ++i)
      if (i != standing.specimen) variance += (values[i] - mean) * (values[i] - mean) / 6;
    const double t = std::abs(values[standing.specimen] - mean) / std::sqrt(variance * 8 / 7);
    EXPECT_NEAR(standing.distance, t, 1e-4 * t);
    EXPECT_NEAR(standing.p_value, 2 * numerics::student_above(t, 6), 1e-4);
  }
}

TEST(Outliers, AStrangerIsFoundAndItsParameterNamed) {
  simulated::Normal normal(15);
  std::vector<Eigen::VectorXd> xi;
  for (int i = 0; i < 12; ++i) xi.push_back(simulated::strip().typical + 0.2 * normal.vector(3));
  xi[4][1] += 2;
  const Cohort cohort = simulated::cohort(simulated::strip(), xi, normal);
  const auto standings = outliers(cohort, estimate(cohort, quick()));
  EXPECT_EQ(standings[0].specimen, 4u);
  EXPECT_EQ(standings[0].farthest, 1u);
  EXPECT_TRUE(standings[0].outlying);
  EXPECT_FALSE(standings[1].outlying);
}

// 400 cohorts without a stranger, seeds 1000 … 1399: Holm's error of 0.05 gives at most 35 with probability 0.9990.
TEST(Outliers, AreRarelyFoundWhereThereAreNone) {
  int found = 0;
  for (std::uint64_t seed = 1000; seed < 1400; ++seed) {
    simulated::Normal normal(seed);
    const Cohort cohort = exact_normal(8, 3, normal);
    found += outliers(cohort, estimate(cohort, quick()))[0].outlying;
  }
  EXPECT_LE(found, 35);
  RecordProperty("found", found);
}
