// SPDX-License-Identifier: Apache-2.0
// Mechanisms as the only explanation of several specimens: what each specimen says of them, added up by hand.
#include "discovery/common/common_rivals.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace tunica::discovery::common_rivals_test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double ln2 = std::numbers::ln2;

/// A base of which each specimen says this, and has this |r|².
CommonFit base_of(const std::vector<std::pair<double, double>>& evidence_and_squares) {
  CommonFit base;
  for (const auto& [evidence, squares] : evidence_and_squares) {
    SetFit one;
    one.log_evidence = evidence;
    one.fit.chi2 = squares;
    base.specimens.push_back(one);
  }
  return base;
}

/// What a specimen says of a mechanism of the prior −3: ln of the evidence without it.
Rival rival(const std::string& id, double says, double squares) {
  Rival one;
  one.id = id;
  one.log_prior = -3;
  one.log_evidence = one.log_prior + says;
  one.chi2 = squares;
  return one;
}

// Of "m" the first specimen says 5 more than of the base, the second less, the third nothing.
TEST(CommonRivals, HaveTheBaseWhereASpecimenDoesNotShowThem) {
  const CommonFit base = base_of({{-20, 40}, {-30, 60}, {-10, 20}});
  const auto common = common_rivals({{rival("m", -15, 30)}, {rival("m", -31, 58)}, {}}, base);
  ASSERT_THAT(common, SizeIs(1));
  EXPECT_EQ(common[0].id, "m");
  EXPECT_NEAR(common[0].log_evidence, -3 - 15 - 30 - 10 - 3 * ln2, 1e-12);
  EXPECT_EQ(common[0].log_prior, -3);
  EXPECT_EQ(common[0].chi2, 30 + 60 + 20);
}

TEST(CommonRivals, AreKnownFromWhicheverSpecimenAndStandByWhatAllSay) {
  const CommonFit base = base_of({{-20, 40}, {-20, 40}});
  const auto common =
      common_rivals({{rival("a", -19, 38), rival("b", -12, 24)}, {rival("c", -2, 4), rival("b", -12, 24)}}, base);
  ASSERT_THAT(common, SizeIs(3));
  EXPECT_EQ(common[0].id, "c");
  EXPECT_EQ(common[1].id, "b");
  EXPECT_EQ(common[2].id, "a");
  EXPECT_NEAR(common[0].log_evidence, -3 - 22 - 2 * ln2, 1e-12);
  EXPECT_NEAR(common[1].log_evidence, -3 - 24 - 2 * ln2, 1e-12);
}

TEST(CommonRivals, ThatSayTheSameStandByName) {
  const CommonFit base = base_of({{-20, 40}});
  const auto common = common_rivals({{rival("z", -12, 24), rival("y", -12, 24)}}, base);
  ASSERT_THAT(common, SizeIs(2));
  EXPECT_EQ(common[0].id, "y");
}

TEST(CommonRivals, ThatSayNoMoreThanTheBaseDoNotShow) {
  const CommonFit base = base_of({{-20, 40}});
  EXPECT_EQ(common_rivals({{rival("m", -20, 30)}}, base).at(0).chi2, 40);
  EXPECT_EQ(common_rivals({{rival("m", -19.9, 30)}}, base).at(0).chi2, 30);
}

TEST(CommonRivals, OfNothingAreNone) {
  EXPECT_THAT(common_rivals({{}, {}}, base_of({{-20, 40}, {-20, 40}})), IsEmpty());
}

/// A rival in ten specimens, of which the first `showing` show it, the first `plausible` at an amplitude one would
/// believe; what it leaves is noise in the last `clean`.
Rival of_ten(int showing, int plausible, int clean) {
  std::vector<std::vector<Rival>> specimens;
  for (int s = 0; s < 10; ++s) {
    Rival one = rival("m", s < showing ? -12 : -21, 24);
    one.plausible = s < plausible;
    one.clean = s >= 10 - clean;
    specimens.push_back({one});
  }
  return common_rivals(specimens, base_of(std::vector<std::pair<double, double>>(10, {-20, 40}))).at(0);
}

TEST(CommonRivals, ArePlausibleInHalfOfTheSpecimensThatShowThem) {
  EXPECT_TRUE(of_ten(6, 3, 0).plausible);
  EXPECT_FALSE(of_ten(6, 2, 0).plausible);
  EXPECT_TRUE(of_ten(2, 1, 0).plausible);
  EXPECT_FALSE(of_ten(3, 1, 0).plausible);
  EXPECT_FALSE(of_ten(8, 3, 0).plausible) << "those that do not show it say nothing";
  EXPECT_TRUE(of_ten(0, 10, 0).plausible) << "nor is there doubt where none does";
}

TEST(CommonRivals, LeaveNoiseInNineOfTenSpecimens) {
  EXPECT_TRUE(of_ten(10, 10, 10).clean);
  EXPECT_TRUE(of_ten(0, 0, 9).clean) << "whether it shows or not";
  EXPECT_FALSE(of_ten(10, 10, 8).clean);
  const CommonFit base = base_of({{-20, 40}, {-20, 40}});
  Rival clean = rival("m", -12, 24);
  clean.clean = true;
  EXPECT_TRUE(common_rivals({{clean}, {clean}}, base).at(0).clean);
  EXPECT_FALSE(common_rivals({{clean}, {}}, base).at(0).clean) << "a specimen that has none of it";
}

}  // namespace
}  // namespace tunica::discovery::common_rivals_test
