// SPDX-License-Identifier: Apache-2.0
#include "population/mixed_model.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "population/simulated.hpp"

namespace tunica::population {
namespace {

using testing::known;
using testing::vector;

double mean_of(const std::vector<double>& x) {
  double sum = 0;
  for (const double one : x) sum += one;
  return sum / static_cast<double>(x.size());
}

double squares_of(const std::vector<double>& x) {
  double sum = 0;
  for (const double one : x) sum += std::pow(one - mean_of(x), 2);
  return sum;
}

TEST(MixedModel, OfKnownSpecimensGivesTheirMeanAndStandardDeviation) {
  const std::vector<double> values{1.2, 0.7, 1.9, 1.1, 0.4};
  std::vector<Individual> individuals;
  for (std::size_t k = 0; k < values.size(); ++k) individuals.push_back(known(vector({values[k]}), vector({1}), k));
  const Estimates found = estimate(individuals, {});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.B(0, 0), mean_of(values), 1e-9);
  EXPECT_NEAR(found.omega(0, 0), squares_of(values) / 4, 1e-4 * found.omega(0, 0));
  EXPECT_NEAR(found.covariance(0, 0), squares_of(values) / 20, 1e-4 * found.covariance(0, 0));
  // Maximum likelihood divides by n.
  EXPECT_NEAR(estimate(individuals, {}, {}, false).omega(0, 0), squares_of(values) / 5, 1e-4);
}

/// Balanced one-way layout: REML is the analysis of variance where the estimate is positive (S. R. Searle, G. Casella,
/// C. E. McCulloch, Variance Components, 1992, section 3.8).
TEST(MixedModel, OfAnimalsIsTheAnalysisOfVariance) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  constexpr std::size_t animals = 6, each = 4;
  std::vector<Individual> individuals;
  std::vector<double> means;
  double within = 0;
  for (std::size_t animal = 0; animal < animals; ++animal) {
    const double a = 0.8 * normal(generator);
    std::vector<double> values;
    for (std::size_t k = 0; k < each; ++k) {
      values.push_back(2 + a + 0.3 * normal(generator));
      individuals.push_back(known(vector({values.back()}), vector({1}), animal));
    }
    means.push_back(mean_of(values));
    within += squares_of(values);
  }
  const double mean_square_within = within / (animals * (each - 1));
  const double mean_square_between = each * squares_of(means) / (animals - 1);
  ASSERT_GT(mean_square_between, mean_square_within);
  const Estimates found = estimate(individuals, {false, true});
  EXPECT_NEAR(found.omega(0, 0), mean_square_within, 1e-4 * mean_square_within);
  EXPECT_NEAR(found.omega_animals(0, 0), (mean_square_between - mean_square_within) / each, 1e-4 * mean_square_between);
  EXPECT_NEAR(found.B(0, 0), mean_of(means), 1e-8);
  EXPECT_NEAR(found.covariance(0, 0), mean_square_between / (animals * each), 1e-4 * mean_square_between);
}

/// Two coordinates; odd specimens say nothing of the second. The mean of the first is that of all, the mean of the
/// second that of the even ones.
TEST(MixedModel, TakesWhatEachSpecimenSays) {
  const std::vector<double> first{1.0, 1.4, 0.8, 1.3, 1.1, 0.6}, second{2.0, 9, 3.0, 9, 2.2, 9};
  std::vector<Individual> individuals;
  for (std::size_t k = 0; k < first.size(); ++k) {
    Individual one = known(vector({first[k], second[k]}), vector({1}), k);
    if (k % 2 == 1) {
      one.data.information(1, 1) = 0;
    }
    individuals.push_back(one);
  }
  const Estimates found = estimate(individuals, {});
  EXPECT_NEAR(found.B(0, 0), mean_of(first), 1e-7);
  EXPECT_NEAR(found.B(1, 0), mean_of({2.0, 3.0, 2.2}), 1e-7);
  EXPECT_NEAR(found.omega(1, 1), squares_of({2.0, 3.0, 2.2}) / 2, 1e-3 * found.omega(1, 1));
  // The odd ones borrow the mean, with all of its spread.
  const Gaussian borrowed = posterior(individuals[1].data, found.mean(individuals[1].design), found.omega);
  EXPECT_NEAR(borrowed.mean[1], found.B(1, 0), 1e-7);
  EXPECT_NEAR(borrowed.covariance(1, 1), found.omega(1, 1), 1e-9);
}

TEST(MixedModel, FindsNoSpreadWhereSpecimensAreAlike) {
  std::mt19937 generator(4);
  std::normal_distribution<double> normal;
  std::vector<Individual> individuals;
  for (std::size_t k = 0; k < 10; ++k)  // less scatter than the noise of a specimen, 0.1
    individuals.push_back(known(vector({1 + 0.02 * normal(generator)}), vector({1}), k, 100));
  const Estimates found = estimate(individuals, {});
  EXPECT_LT(std::sqrt(found.omega(0, 0)), 1e-3);
  EXPECT_EQ(spread_intervals(individuals, {}, found)[0].lower, 0);
}

TEST(MixedModel, ComparesGroups) {
  const std::vector<double> control{1.0, 1.3, 0.9, 1.2}, treated{1.8, 1.5, 1.9};
  std::vector<Individual> individuals;
  for (const double value : control) individuals.push_back(known(vector({value}), vector({1, 0}), individuals.size()));
  for (const double value : treated) individuals.push_back(known(vector({value}), vector({1, 1}), individuals.size()));
  const Estimates found = estimate(individuals, {});
  const double pooled = (squares_of(control) + squares_of(treated)) / 5;
  EXPECT_NEAR(found.B(0, 0), mean_of(control), 1e-8);
  EXPECT_NEAR(found.B(0, 1), mean_of(treated) - mean_of(control), 1e-8);
  EXPECT_NEAR(found.covariance(1, 1), pooled * (1.0 / 4 + 1.0 / 3), 1e-4);
}

TEST(MixedModel, WithCovariancesIsTheSampleCovariance) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  std::vector<Individual> individuals;
  Eigen::MatrixXd values(12, 2);
  for (Eigen::Index k = 0; k < 12; ++k) {
    const double a = normal(generator), b = normal(generator);
    values.row(k) << 1 + 0.3 * a, 2 + 0.2 * a + 0.1 * b;
    individuals.push_back(known(values.row(k).transpose(), vector({1}), static_cast<std::size_t>(k)));
  }
  const Eigen::MatrixXd deviations = values.rowwise() - values.colwise().mean();
  const Eigen::MatrixXd sample = deviations.transpose() * deviations / 11;
  const Estimates full = estimate(individuals, {true, false}), diagonal = estimate(individuals, {});
  EXPECT_LT((full.omega - sample).norm(), 1e-3 * sample.norm());
  EXPECT_LT(full.neg2_restricted, diagonal.neg2_restricted - 1) << "the two go together";
  EXPECT_EQ(full.spread_parameters, 3U);
}

/// With n known specimens the profile of −2 ln L of a standard deviation s is (n − 1)(ln s² + v/s²), v the sample
/// variance.
TEST(MixedModel, SpreadHasTheIntervalOfItsProfile) {
  std::vector<Individual> individuals;
  const std::vector<double> values{1.2, 0.7, 1.9, 1.1, 0.4, 1.3};
  for (std::size_t k = 0; k < values.size(); ++k) individuals.push_back(known(vector({values[k]}), vector({1}), k));
  const double v = squares_of(values) / 5;
  const SpreadInterval interval = spread_intervals(individuals, {}, estimate(individuals, {}))[0];
  const auto rise = [&](double s) { return 5 * (std::log(s * s / v) + v / (s * s) - 1); };
  ASSERT_TRUE(interval.upper);
  EXPECT_NEAR(rise(interval.lower), 3.8415, 1e-2);
  EXPECT_NEAR(rise(*interval.upper), 3.8415, 1e-2);
  EXPECT_LT(interval.lower, std::sqrt(v));
  EXPECT_GT(*interval.upper, std::sqrt(v));
}

TEST(MixedModel, DoesNotDependOnTheOrderOfSpecimens) {
  std::mt19937 generator(6);
  std::normal_distribution<double> normal;
  std::vector<Individual> individuals;
  for (std::size_t k = 0; k < 8; ++k)
    individuals.push_back(known(vector({normal(generator), normal(generator)}), vector({1}), k, 50));
  const Estimates one = estimate(individuals, {});
  std::reverse(individuals.begin(), individuals.end());
  const Estimates other = estimate(individuals, {});
  EXPECT_LT((one.B - other.B).norm(), 1e-7);
  EXPECT_LT((one.omega - other.omega).norm(), 1e-5);
}

TEST(MixedModel, KeepsAliveWithTwoSpecimens) {
  const std::vector<Individual> two{known(vector({1.0}), vector({1}), 0), known(vector({1.5}), vector({1}), 1)};
  const Estimates found = estimate(two, {});
  EXPECT_NEAR(found.B(0, 0), 1.25, 1e-9);
  EXPECT_NEAR(found.omega(0, 0), 0.125, 1e-4);
}

}  // namespace
}  // namespace tunica::population
