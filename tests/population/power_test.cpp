// SPDX-License-Identifier: Apache-2.0
#include "population/power.hpp"

#include <gtest/gtest.h>

namespace tunica::population {
namespace {

/// Two groups of 64 and half a standard deviation: power 0.80 (J. Cohen, Psychological Bulletin 112:155, 1992, table
/// 2).
TEST(Power, IsThatOfTheTables) {
  EXPECT_NEAR(power(0.5, 1, 64), 0.80, 0.005);
  EXPECT_NEAR(power(0.8, 1, 26), 0.80, 0.01);
  EXPECT_EQ(specimens_needed(0.5, 1), 64U);
  EXPECT_EQ(specimens_needed(0.8, 1), 26U);
}

TEST(Power, WithoutADifferenceIsTheLevel) { EXPECT_NEAR(power(0, 1, 10), 0.05, 1e-9); }

TEST(Power, OfTheDetectableDifferenceIsEightyPerCent) {
  for (const double n : {2.0, 5.0, 20.0}) EXPECT_NEAR(power(detectable_difference(0.09, n), 0.09, n), 0.8, 1e-9);
}

TEST(Power, SaysWhereNoNumberOfSpecimensIsEnough) { EXPECT_FALSE(specimens_needed(0.001, 1)); }

}  // namespace
}  // namespace tunica::population
