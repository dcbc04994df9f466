// SPDX-License-Identifier: Apache-2.0
// Which explanations count as one.
#include <gmock/gmock.h>

#include <cmath>

#include "diagnosis/credible.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A diagnosis whose mechanisms have one signature each, at these angles in a plane, in degrees.
Diagnosis at_angles(const std::vector<double>& angles) {
  Diagnosis d;
  d.candidates.resize(angles.size());
  for (std::size_t c = 0; c < angles.size(); ++c) {
    Direction direction;
    const double angle = angles[c] * M_PI / 180;
    direction.candidate = c, direction.unit = Eigen::Vector2d(std::cos(angle), std::sin(angle));
    d.directions.push_back(direction);
  }
  return d;
}

TEST(Credible, LookAlikesAreOneExplanationThroughAChain) {
  // cos 20° = 0.94, cos 40° = 0.77; 180° is the same line.
  const Diagnosis d = at_angles({0, 40, 90, 20, 180});
  EXPECT_THAT(classes_of(d, {{0}, {1}, {2}}), ElementsAre(0, 1, 2));
  EXPECT_THAT(classes_of(d, {{0}, {1}, {2}, {3}, {4}}), ElementsAre(0, 0, 1, 0, 0));
  EXPECT_THAT(classes_of(d, {}), IsEmpty());
}

TEST(Credible, PairsLookAlikeWhereTheirMembersDoOneToOne) {
  const Diagnosis d = at_angles({0, 10, 90, 100, 45});
  EXPECT_THAT(classes_of(d, {{0, 2}, {3, 1}, {0, 1}, {0, 4}}), ElementsAre(0, 0, 1, 2));
  EXPECT_THAT(classes_of(d, {{0}, {0, 2}}), ElementsAre(0, 1)) << "one is no pair";
}

}  // namespace
}  // namespace tunica::diagnosis
