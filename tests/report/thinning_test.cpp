// SPDX-License-Identifier: Apache-2.0
#include "report/thinning.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>

using namespace tunica::report;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Evenly, TakesAllWhereThatIsEnough) {
  EXPECT_THAT(evenly(3, 5), ElementsAre(0, 1, 2));
  EXPECT_THAT(evenly(0, 5), IsEmpty());
  EXPECT_THAT(evenly(5, 0), IsEmpty());
}

TEST(Evenly, KeepsTheFirstAndTheLastAndNothingTwice) {
  EXPECT_THAT(evenly(100, 1), ElementsAre(0));
  for (std::size_t most = 2; most < 30; ++most) {
    const auto places = evenly(100, most);
    ASSERT_EQ(places.size(), most);
    EXPECT_EQ(places.front(), 0u);
    EXPECT_EQ(places.back(), 99u);
    EXPECT_TRUE(std::adjacent_find(places.begin(), places.end(), std::greater_equal<>()) == places.end());
  }
}

TEST(ShapeKeeping, LosesNoPeak) {
  std::vector<double> y(5000, 1.0);
  y[1234] = 7;
  y[4321] = -7;
  const auto kept = shape_keeping(y, 100);
  EXPECT_LE(kept.size(), 100u);
  EXPECT_EQ(kept.front(), 0u);
  EXPECT_EQ(kept.back(), 4999u);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_NE(std::find(kept.begin(), kept.end(), 1234u), kept.end());
  EXPECT_NE(std::find(kept.begin(), kept.end(), 4321u), kept.end());
}

TEST(ShapeKeeping, LeavesShortCurvesAloneAndDropsWhatIsNoNumber) {
  const std::vector<double> y{1, NAN, 3, INFINITY, 5};
  EXPECT_THAT(shape_keeping(y, 10), ElementsAre(0, 2, 4));
  EXPECT_THAT(shape_keeping({}, 10), IsEmpty());
}
