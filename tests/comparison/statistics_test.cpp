// SPDX-License-Identifier: Apache-2.0
#include "comparison/statistics.hpp"

#include <vector>

#include <gtest/gtest.h>

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

TEST(Statistics, DrawABoxWithQuartilesBetweenTheValues) {
  const auto box = *sample_statistics(std::vector<double>{7, 1, 3, 5}).box;
  EXPECT_EQ(box.min, 1);
  EXPECT_DOUBLE_EQ(box.lower, 2.5);
  EXPECT_DOUBLE_EQ(box.median, 4);
  EXPECT_DOUBLE_EQ(box.upper, 5.5);
  EXPECT_EQ(box.max, 7);
  EXPECT_EQ(sample_statistics(std::vector<double>{3}).box->upper, 3);
}

TEST(Statistics, GiveWilsonsIntervalOfASuccessRate) {
  // Newcombe, Stat. Med. 17:857 (1998), table I, method 3: 81 of 263, 15 of 148, 0 of 20, 1 of 29.
  const auto expect = [](std::size_t k, std::size_t n, double low, double high) {
    const auto [below, above] = wilson_interval(k, n);
    EXPECT_NEAR(below, low, 5e-5) << k << " of " << n;
    EXPECT_NEAR(above, high, 5e-5) << k << " of " << n;
  };
  expect(81, 263, 0.2553, 0.3662);
  expect(15, 148, 0.0624, 0.1605);
  expect(0, 20, 0, 0.1611);
  expect(1, 29, 0.0061, 0.1718);
  EXPECT_EQ(wilson_interval(100, 100).second, 1);
  EXPECT_EQ(wilson_interval(0, 0), Interval(0, 1));
}
