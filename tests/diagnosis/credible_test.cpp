// SPDX-License-Identifier: Apache-2.0
// Which explanations count as one.
#include "diagnosis/naming/credible.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Signatures at these angles in a plane, in degrees.
std::vector<Direction> at_angles(const std::vector<double>& angles) {
  std::vector<Direction> directions(angles.size());
  for (std::size_t k = 0; k < angles.size(); ++k) {
    directions[k].candidate = k;
    directions[k].unit = Eigen::Vector2d(std::cos(angles[k] * M_PI / 180), std::sin(angles[k] * M_PI / 180));
  }
  return directions;
}

TEST(Credible, LookAlikesOfTheLikeliestAreOneExplanationWithIt) {
  // cos 20° = 0.94, cos 40° = 0.77; 180° is the same line.
  const auto directions = at_angles({0, 40, 90, 20, 180});
  EXPECT_THAT(classes_of(directions, {{0}, {1}, {2}, {3}, {4}}), ElementsAre(0, 1, 2, 0, 0)) << "no chain from 0 to 40";
  EXPECT_THAT(classes_of(directions, {{3}, {0}, {1}}), ElementsAre(0, 0, 0)) << "the first stands for its class";
  EXPECT_THAT(classes_of(directions, {}), IsEmpty());
}

TEST(Credible, AMechanismLooksLikeAnotherWhereverItMayAct) {
  auto directions = at_angles({0, 90, 10});
  directions[2].candidate = 1;
  EXPECT_NEAR(likeness(directions, 0, 1), std::cos(10 * M_PI / 180), 1e-12);
  EXPECT_EQ(likeness(directions, 0, 5), 0);
  EXPECT_THAT(classes_of(directions, {{0}, {1}}), ElementsAre(0, 0));
}

TEST(Credible, PairsLookAlikeWhereTheirMembersDoOneToOne) {
  const auto directions = at_angles({0, 10, 90, 100, 45});
  EXPECT_THAT(classes_of(directions, {{0, 2}, {3, 1}, {0, 1}, {0, 4}}), ElementsAre(0, 0, 1, 2));
  EXPECT_THAT(classes_of(directions, {{0}, {0, 2}}), ElementsAre(0, 1)) << "one is no pair";
}

}  // namespace
}  // namespace tunica::diagnosis
