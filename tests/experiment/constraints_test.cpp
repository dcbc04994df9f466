// SPDX-License-Identifier: Apache-2.0
#include "experiment/reading.hpp"

namespace tunica::experiment {
namespace {

using testing::expect_within;

struct Constraints : testing::Reading {
  std::string refused(const std::string& stability) { return refusal(R"("h": 0.7)", stability); }
  ConstraintEntry entry(const std::string& stability) {
    return read(with(R"("h": 0.7)", stability)).runs[0].constraints.at(0);
  }
};

TEST_F(Constraints, DefaultToTheCriterionItselfInBothDirections) {
  const auto read = entry(R"("points": 20)");
  EXPECT_EQ(read.h, (StabilityFactor{{1, 1}}));
  EXPECT_FALSE(read.range);
  EXPECT_EQ(read.points, 20u);
  EXPECT_TRUE(read.directions[0] && read.directions[1]);
}

TEST_F(Constraints, ReadATableOfFactorsARangeAndOneDirection) {
  const auto read = entry(R"("h": [[1, 0.5], [1.4, 1]], "range": [1, 1.8], "directions": ["axial"])");
  EXPECT_EQ(read.h, (StabilityFactor{{1, 0.5}, {1.4, 1}}));
  EXPECT_EQ(read.range, (std::pair<double, double>{1, 1.8}));
  EXPECT_FALSE(read.directions[0]);
  EXPECT_TRUE(read.directions[1]);
}

TEST_F(Constraints, RefuseFactorsThatAreNone) {
  expect_within(refused(R"("h": 1.2)"), "a number from 0 to 1, or a table [[stretch, h], …]");
  expect_within(refused(R"("h": [])"), "a number from 0 to 1, or a table");
  expect_within(refused(R"("h": [[1, 0.5, 2]])"), "a pair [stretch, h]");
  expect_within(refused(R"("h": [[1.2, 0.5], [1.1, 0.6]])"), "the stretch 1.1 does not lie above 1.2");
}

TEST_F(Constraints, RefuseRangesPointsAndDirectionsThatAreNone) {
  expect_within(refused(R"("range": [1.8, 1])"), "the range goes from 1.8 to 1 ");
  expect_within(refused(R"("range": 1.8)"), "two stretches [from, to], 0 < from < to,");
  expect_within(refused(R"("points": 1)"), "a whole number of stretches from 2");
  expect_within(refused(R"("directions": ["axal"])"), "unknown direction 'axal'");
}

TEST_F(Constraints, RefuseKeysOfAnotherType) {
  expect_within(refusal(R"("type": "transverse_stability", "h": 0.7)", R"("type": "admissible_parameters", "h": 0.7)"),
                "unknown key 'h' in the constraint 'admissible_parameters'");
}

}  // namespace
}  // namespace tunica::experiment
