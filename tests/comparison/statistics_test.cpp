// SPDX-License-Identifier: Apache-2.0
#include "comparison/statistics.hpp"

#include <gtest/gtest.h>

#include <vector>

using namespace tunica::comparison;

TEST(Statistics, OfASampleAreThoseOfTheTextbook) {
  // mean 5, s² = 32/7; t(0.975, 7) = 2.364624.
  const auto sample = sample_statistics(std::vector<double>{2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_DOUBLE_EQ(sample.mean, 5);
  EXPECT_NEAR(*sample.sd, 2.1380899, 1e-7);
  EXPECT_NEAR(sample.ci95->second - 5, 2.364624 * 2.1380899 / 2.8284271, 1e-6);
  EXPECT_NEAR(sample.ci95->first + sample.ci95->second, 10, 1e-12);
}

TEST(Statistics, OfOneValueHaveNoSpread) {
  const auto one = sample_statistics(std::vector<double>{3});
  EXPECT_EQ(one.mean, 3);
  EXPECT_FALSE(one.sd);
  EXPECT_FALSE(one.ci95);
  EXPECT_EQ(sample_statistics({}).count, 0u);
}

TEST(Statistics, CountASuccessWithinATenthOfAPerCentOrUpToTheTarget) {
  EXPECT_NEAR(success_threshold({}, 66.1), 66.1661, 1e-9);
  EXPECT_EQ(success_threshold(66.101, 12), 66.101);
  EXPECT_GT(success_threshold({}, 0), 0);
  EXPECT_GT(success_threshold({}, -5), -5);
}
