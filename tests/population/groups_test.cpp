// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "numerics/distributions.hpp"
#include "population/factor_test.hpp"
#include "population/multiplicity.hpp"
#include "population/readings.hpp"
#include "population/simulated.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using namespace tunica::population;

namespace {

Options with_factor() {
  Options options;
  options.factors = {0};
  options.intervals_of_spreads = options.maximum_likelihood = false;
  return options;
}

/// Values of one parameter, known exactly, in two groups.
Cohort exact(const std::vector<double>& values, const std::vector<std::size_t>& group) {
  std::vector<Eigen::VectorXd> xi;
  for (const double value : values) xi.push_back(Eigen::VectorXd::Constant(1, value));
  Cohort cohort = simulated::linear(xi, {values.size(), Eigen::MatrixXd::Constant(1, 1, 1e10)});
  cohort.factors = {{"treatment", {"none", "drug"}}};
  for (std::size_t i = 0; i < values.size(); ++i) cohort.specimens[i].levels = {group[i]};
  return cohort;
}

FactorTest tested(const Cohort& cohort, const FactorTestOptions& options = {}) {
  return test_factor(cohort, estimate(cohort, with_factor()), 0, options);
}

double difference(const std::vector<double>& values, const std::vector<std::size_t>& group) {
  double sum[2] = {0, 0}, count[2] = {0, 0};
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum[group[i]] += values[i];
    ++count[group[i]];
  }
  return sum[1] / count[1] - sum[0] / count[0];
}

const std::vector<double> eight = {1.2, 0.7, 1.9, 1.1, 2.3, 1.8, 2.9, 1.6};
const std::vector<std::size_t> halves = {0, 0, 0, 0, 1, 1, 1, 1};

}  // namespace

TEST(Groups, OfExactValuesHaveTheIntervalOfStudentsTwoSampleTest) {
  const FactorTest found = tested(exact(eight, halves));
  double squares = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    const double mean = i < 4 ? 4.9 / 4 : 8.6 / 4;
    squares += (eight[i] - mean) * (eight[i] - mean);
  }
  const double error = std::sqrt(squares / 6 / 2), t = (8.6 - 4.9) / 4 / error;
  EXPECT_NEAR(found.effects[0].difference.value, 3.7 / 4, 1e-8);
  EXPECT_NEAR(found.effects[0].difference.standard_error, error, 1e-5);
  EXPECT_EQ(found.effects[0].difference.freedom, 6);
  EXPECT_NEAR(found.parameters[0].p_value, 2 * numerics::student_above(t, 6), 1e-5);
  EXPECT_FALSE(found.effects[0].ratio);
  // n log(RSS_0/RSS_1) for exact values.
  double all = 0;
  for (const double value : eight) all += (value - 13.5 / 8) * (value - 13.5 / 8);
  EXPECT_NEAR(found.likelihood_ratio.statistic, 8 * std::log(all / squares), 1e-4);
}

TEST(Groups, PermutationIsTheEnumerationOfDifferencesOfMeans) {
  const FactorTest found = tested(exact(eight, halves));
  std::vector<std::size_t> group = halves;
  int reached = 0, all = 0;
  do {
    reached += std::abs(difference(eight, group)) >= std::abs(difference(eight, halves)) - 1e-12;
    ++all;
  } while (std::next_permutation(group.begin(), group.end()));
  EXPECT_EQ(all, 70);
  EXPECT_TRUE(found.permutation.exhaustive);
  EXPECT_EQ(found.permutation.used, 70u);
  EXPECT_DOUBLE_EQ(found.permutation.p_value, reached / 70.0);
  EXPECT_DOUBLE_EQ(found.parameters[0].permutation, reached / 70.0);
  EXPECT_DOUBLE_EQ(found.permutation.smallest, 2 / 70.0);
}

TEST(Groups, WithinAnimalsIsTheSignTestOfTheirDifferences) {
  Cohort cohort = exact(eight, {0, 1, 0, 1, 0, 1, 0, 1});
  cohort.animals = {"a", "b", "c", "d"};
  for (std::size_t i = 0; i < 8; ++i) cohort.specimens[i].animal = i / 2;
  const FactorTest found = tested(cohort);
  double observed = 0;
  std::vector<double> differences;
  for (std::size_t k = 0; k < 4; ++k) {
    differences.push_back(eight[2 * k + 1] - eight[2 * k]);
    observed += differences.back();
  }
  int reached = 0;
  for (unsigned signs = 0; signs < 16; ++signs) {
    double sum = 0;
    for (unsigned k = 0; k < 4; ++k) sum += (signs >> k & 1u ? -1 : 1) * differences[k];
    reached += std::abs(sum) >= std::abs(observed) - 1e-12;
  }
  EXPECT_EQ(found.permutation.scheme, Scheme::within_animals);
  EXPECT_EQ(found.permutation.possible, 16);
  EXPECT_DOUBLE_EQ(found.permutation.p_value, reached / 16.0);
  EXPECT_EQ(found.effects[0].difference.freedom, 8 - 4 - 1);
}

TEST(Groups, ConstantInAnimalsExchangesWholeAnimals) {
  Cohort cohort = exact(eight, halves);
  cohort.animals = {"a", "b", "c", "d"};
  for (std::size_t i = 0; i < 8; ++i) cohort.specimens[i].animal = i / 2;
  const FactorTest found = tested(cohort);
  EXPECT_EQ(found.permutation.scheme, Scheme::over_animals);
  EXPECT_EQ(found.permutation.possible, 6);
  EXPECT_DOUBLE_EQ(found.permutation.smallest, 2 / 6.0);
  EXPECT_EQ(found.effects[0].difference.freedom, 4 - 2);
}

TEST(Groups, LabelsMoveOnlyWhereOtherFactorsAgree) {
  Cohort cohort = exact(eight, halves);
  cohort.factors.push_back({"sex", {"f", "m"}});
  for (std::size_t i = 0; i < 8; ++i) cohort.specimens[i].levels = {i / 4, i % 2};
  const Arrangements all = arrangements(cohort, 0, {1}, 4999, 1);
  EXPECT_EQ(all.possible, 36);  // 6 each
  const std::set<std::vector<std::size_t>> distinct(all.levels.begin(), all.levels.end());
  EXPECT_EQ(distinct.size(), 36u);
  for (const auto& levels : all.levels)
    for (std::size_t sex = 0; sex < 2; ++sex)
      EXPECT_EQ(levels[sex] + levels[sex + 2] + levels[sex + 4] + levels[sex + 6], 2u);
}

TEST(Groups, DrawsAreSeededAndTheSameForAnyThreads) {
  simulated::Normal normal(31);
  std::vector<Eigen::VectorXd> xi;
  for (int i = 0; i < 16; ++i) xi.push_back(simulated::strip().typical + 0.3 * normal.vector(3));
  Cohort cohort = simulated::cohort(simulated::strip(), xi, normal);
  cohort.factors = {{"treatment", {"none", "drug"}}};
  for (std::size_t i = 0; i < 16; ++i) cohort.specimens[i].levels = {i % 2};
  const FactorTest a = tested(cohort, {500, 3});
  EXPECT_FALSE(a.permutation.exhaustive);
  EXPECT_EQ(a.permutation.used, 500u);
  EXPECT_DOUBLE_EQ(a.permutation.smallest, 1 / 501.0);
  EXPECT_EQ(*a.effects[0].ratio, std::exp(a.effects[0].difference.value));
  const oneapi::tbb::global_control serial(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const FactorTest b = tested(cohort, {500, 3});
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_EQ(a.parameters[j].westfall_young, b.parameters[j].westfall_young);
    EXPECT_GE(a.parameters[j].westfall_young, a.parameters[j].permutation);
    EXPECT_GE(a.parameters[j].holm, a.parameters[j].p_value);
  }
}

// Perfectly correlated readings are one: the largest of two equal statistics is either, where Holm pays for both.
TEST(Groups, WestfallAndYoungDoNotPayForTheSameReadingTwice) {
  Cohort base = exact(eight, halves);
  Reading first{"force", false, {}};
  for (const double value : eight) first.values.push_back(Reading::Value{value, 0});
  Reading second = first;
  second.name = "stress";
  for (auto& value : second.values) value->value *= 10;
  const FactorTest found = tested(cohort_of_readings(base, {first, second}));
  const FactorTest alone = tested(base);
  for (const ParameterTest& test : found.parameters) {
    EXPECT_DOUBLE_EQ(test.westfall_young, alone.parameters[0].permutation);
    EXPECT_NEAR(test.p_value, alone.parameters[0].p_value, 1e-4);
    EXPECT_NEAR(test.holm, 2 * alone.parameters[0].p_value, 1e-4);
  }
}

TEST(Groups, ReadingsMayBeMissingAndAreRatiosWhereAsked) {
  Cohort base = exact(eight, halves);
  Reading reading{"stiffness", true, {}};
  for (const double value : eight) reading.values.push_back(Reading::Value{value, 0.1});
  reading.values[2].reset();
  const FactorTest found = tested(cohort_of_readings(base, {reading}));
  ASSERT_TRUE(found.effects[0].ratio);
  double logs = 0;
  for (std::size_t i = 0; i < 8; ++i)
    if (i != 2) logs += std::log(eight[i]) * (i < 4 ? -1.0 / 3 : 0.25);
  EXPECT_NEAR(*found.effects[0].ratio, std::exp(logs), 0.05 * std::exp(logs));  // weighted by their errors
  reading.values[0]->value = -1;
  try {
    cohort_of_readings(base, {reading});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'stiffness' of the specimen 's000' is -1"), std::string::npos);
  }
}

TEST(Multiplicity, OfHolmIsThatOfHisPaper) {
  const std::vector<double> adjusted = holm({0.01, 0.04, 0.03, 0.005});
  EXPECT_EQ(adjusted, (std::vector<double>{0.03, 0.06, 0.06, 0.02}));
}
