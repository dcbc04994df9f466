// SPDX-License-Identifier: Apache-2.0
#include "population/permutation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "population/simulated.hpp"

namespace tunica::population {
namespace {

using testing::known;
using testing::vector;

struct Case {
  std::vector<Individual> individuals;
  FactorColumns factor;
  Estimates null;

  Case(const std::vector<double>& values, const std::vector<std::size_t>& labels, std::vector<std::size_t> animals = {})
      : factor{1, 2, labels} {
    std::vector<Individual> without;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::size_t animal = animals.empty() ? k : animals[k];
      individuals.push_back(known(vector({values[k]}), vector({1, static_cast<double>(labels[k])}), animal));
      without.push_back(known(vector({values[k]}), vector({1}), animal));
    }
    null = estimate(without, {});
  }
};

/// All 20 ways to choose three of six; |t| with a held spread orders them like the difference of means.
TEST(PermutationTest, OfFewSpecimensCountsAllArrangements) {
  const std::vector<double> values{1.0, 1.3, 0.9, 1.8, 1.2, 1.9};
  const std::vector<std::size_t> labels{0, 0, 0, 1, 1, 1};
  const auto difference = [&](const std::vector<std::size_t>& of) {
    double sum = 0;
    for (std::size_t k = 0; k < 6; ++k) sum += (of[k] == 1 ? 1 : -1) * values[k];
    return std::abs(sum);
  };
  std::vector<std::size_t> arranged = labels;
  std::sort(arranged.begin(), arranged.end());
  double reached = 0, all = 0;
  do {
    ++all;
    reached += difference(arranged) >= difference(labels) - 1e-12 ? 1 : 0;
  } while (std::next_permutation(arranged.begin(), arranged.end()));
  const Case one(values, labels);
  const PermutationTest test = permutation_test(one.individuals, one.factor, one.null, 9999, 1);
  EXPECT_TRUE(test.all);
  EXPECT_EQ(test.made, 20U);
  EXPECT_EQ(test.exchange, Exchange::specimens);
  EXPECT_NEAR(test.p[0], reached / all, 1e-12);
  EXPECT_NEAR(test.smallest_p, 0.1, 1e-12) << "two of twenty are the most extreme, one on each side";
}

TEST(PermutationTest, ExchangesWholeAnimalsWhereEachHasOneLevel) {
  const Case one({1, 1.1, 2, 2.2, 1.4, 1.3, 2.1, 1.9}, {0, 0, 1, 1, 0, 0, 1, 1}, {0, 0, 1, 1, 2, 2, 3, 3});
  const PermutationTest test = permutation_test(one.individuals, one.factor, one.null, 9999, 1);
  EXPECT_EQ(test.exchange, Exchange::animals);
  EXPECT_EQ(test.made, 6U) << "two of four animals";
}

TEST(PermutationTest, ExchangesWithinAnimalsWhereTheyHaveBothLevels) {
  const Case one({1, 1.1, 2, 2.2, 1.4, 1.3}, {0, 1, 0, 1, 0, 1}, {0, 0, 1, 1, 2, 2});
  const PermutationTest test = permutation_test(one.individuals, one.factor, one.null, 9999, 1);
  EXPECT_EQ(test.exchange, Exchange::within);
  EXPECT_EQ(test.made, 8U);
}

TEST(PermutationTest, OfManySpecimensDrawsAndRepeats) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  std::vector<std::size_t> labels;
  for (std::size_t k = 0; k < 24; ++k) {
    labels.push_back(k % 2);
    values.push_back(normal(generator));
  }
  const Case one(values, labels);
  const PermutationTest test = permutation_test(one.individuals, one.factor, one.null, 999, 5);
  EXPECT_FALSE(test.all);
  EXPECT_EQ(test.made, 999U);
  EXPECT_EQ(test.p, permutation_test(one.individuals, one.factor, one.null, 999, 5).p);
  EXPECT_EQ(test.smallest_p, 1.0 / 1000);
}

/// 400 cohorts of 4 + 4 without an effect, seed 8: p ≤ 0.05 in at most a twentieth. Of 70 arrangements p is a multiple
/// of 2/70, so that the level is 2/70 = 0.029; more than 25 of 400 have a chance below 1e-3.
TEST(PermutationTest, KeepsItsLevel) {
  std::mt19937 generator(8);
  std::normal_distribution<double> normal;
  int alarms = 0;
  for (int cohort = 0; cohort < 400; ++cohort) {
    std::vector<double> values;
    for (int k = 0; k < 8; ++k) values.push_back(normal(generator));
    const Case one(values, {0, 1, 0, 1, 0, 1, 0, 1});
    alarms += permutation_test(one.individuals, one.factor, one.null, 9999, 1).p[0] <= 0.05 ? 1 : 0;
  }
  EXPECT_LE(alarms, 25);
  EXPECT_GE(alarms, 2) << "a test that never alarms is no test";
}

}  // namespace
}  // namespace tunica::population
