// SPDX-License-Identifier: Apache-2.0
// The claimed explanation of the misfit, from fitted explanations.
#include "diagnosis/naming/claims.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"
#include "numerics/distributions.hpp"

namespace tunica::diagnosis::claims_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Names = std::vector<std::string>;

/// Mechanisms "m0", "m1", … each of which explains the square of a row of its own.
struct Rows : OneRowEach {
  explicit Rows(const std::vector<double>& squares) : OneRowEach(squares) {
    add_each(static_cast<Eigen::Index>(squares.size()));
    close();
  }
  [[nodiscard]] Single single_of(const std::string& id, double log_weight) const {
    Single made = single(id);
    made.log_weight = log_weight;
    return made;
  }
  [[nodiscard]] Group group_with(const std::vector<std::string>& ids, double log_weight) const {
    std::vector<std::size_t> directions;
    for (const std::string& id : ids) directions.push_back(direction(id));
    Group group = group_of(directions);
    group.log_weight = log_weight;
    return group;
  }
};

std::vector<RankedMechanism> with_probabilities(const std::vector<double>& probabilities) {
  std::vector<RankedMechanism> ranking;
  for (const double one : probabilities) ranking.push_back({"", {}, one, 0, std::nullopt, {}});
  return ranking;
}

Names ids_of(const std::vector<Cause>& causes) {
  Names ids;
  for (const Cause& cause : causes) ids.push_back(cause.id);
  return ids;
}

// 0.6 and 0.3 are less than 92.5 %, so that the third belongs to the set; of the others the one that leaves least.
TEST(ClaimOfOne, HoldsTheLikeliestUpToTheirMass) {
  const Rows rows({50, 40, 30, 20, 25, 10});
  std::vector<Single> singles;
  for (const char* id : {"m0", "m1", "m2", "m3", "m4", "m5"}) singles.push_back(rows.single(id));
  const WeighedClaim found =
      claim_one(rows.inquiry(), rows.analysis, singles, with_probabilities({0.6, 0.3, 0.04, 0.03, 0.02, 0.01}));
  const Claim& claim = found.claim;
  EXPECT_EQ(claim.named, 1u);
  EXPECT_THAT(ids_of(claim.causes), ElementsAre("m0", "m1", "m2"));
  EXPECT_THAT(claim.ambiguity_set, ElementsAre("m0", "m1", "m2"));
  EXPECT_THAT(claim.look_alikes, ElementsAre(Names{"m0"}, Names{"m1"}, Names{"m2"}));
  EXPECT_THAT(claim.rivals, SizeIs(3));
  EXPECT_NEAR(claim.rivals[1].fit.chi2, 135, 1e-3);
  EXPECT_NEAR(claim.best->fit.chi2, 125, 1e-3);
  EXPECT_EQ(claim.causes[1].probability, 0.3);
  EXPECT_NEAR(claim.causes[2].p_value, numerics::chi_squared_above(30, 1), 1e-6 * numerics::chi_squared_above(30, 1))
      << "no draw says anything: one hypothesis";
  ASSERT_TRUE(claim.best_rejected);
  EXPECT_EQ(claim.best_rejected->id, "m4");
  EXPECT_NEAR(claim.best_rejected->after, 150, 1e-3);
  EXPECT_THAT(found.directions, ElementsAre(rows.direction("m0")));
  EXPECT_EQ(found.explanations, 3u);
  EXPECT_FALSE(found.alone);
  EXPECT_EQ(found.correction, "");
}

TEST(ClaimOfOne, StandsAloneWhereItHoldsTheMassByItself) {
  const Rows rows({50, 40});
  const auto claimed = [&](double probability) {
    return claim_one(rows.inquiry(), rows.analysis, {rows.single("m0"), rows.single("m1")},
                     with_probabilities({probability, 1 - probability}));
  };
  EXPECT_TRUE(claimed(0.93).alone);
  EXPECT_EQ(claimed(0.93).explanations, 1u);
  EXPECT_EQ(claimed(0.93).claim.best_rejected->id, "m1");
  EXPECT_FALSE(claimed(0.92).alone);
  EXPECT_FALSE(claimed(0.92).claim.best_rejected);
}

TEST(ClaimOfOne, LeavesOutWhatWasNotFitted) {
  const Rows rows({50, 40, 30});
  std::vector<Single> singles{rows.single("m0"), rows.single("m1"), rows.single("m2")};
  singles[1].best.reset();
  const Claim claim = claim_one(rows.inquiry(), rows.analysis, singles, with_probabilities({0.5, 0.45, 0.05})).claim;
  EXPECT_THAT(ids_of(claim.causes), ElementsAre("m0", "m2")) << "0.45 is not counted";
  EXPECT_EQ(claim.causes[1].probability, 0.05);
}

// p and q look alike, r does not.
TEST(ClaimOfOne, CountsLookAlikesOnce) {
  MadeUpCauses causes({3}, Eigen::Vector3d(5, 1, 4));
  causes.add({"p", Eigen::Vector3d(1, 0, 0)});
  causes.add({"r", Eigen::Vector3d(0, 0, 1)});
  causes.add({"q", Eigen::Vector3d(1, 0.2, 0)});
  causes.close();
  const WeighedClaim found =
      claim_one(causes.inquiry(), causes.analysis, {causes.single("p"), causes.single("r"), causes.single("q")},
                with_probabilities({0.5, 0.3, 0.2}));
  EXPECT_THAT(found.claim.look_alikes, ElementsAre(Names({"p", "q"}), Names{"r"}));
  EXPECT_EQ(found.explanations, 2u);
  EXPECT_FALSE(found.alone) << "three mechanisms all the same";
}

// Of pairs with the weights 12, 11, 4 and a single with 9 + ln odds, those are 0.705, 0.259, 0.0002 and 0.035; m0 alone
// has next to nothing. The set holds the first two.
TEST(ClaimOfSeveral, WeighsPairsAgainstPairsAndSingles) {
  const Rows rows({50, 40, 30, 20, 60, 10});
  const double odds = log_odds_of_pair(2);
  const std::vector<Group> groups{rows.group_with({"m0", "m1"}, 12), rows.group_with({"m0", "m2"}, 11),
                                  rows.group_with({"m2", "m3"}, 4), rows.group_with({"m0", "m1", "m2"}, 20)};
  const std::vector<Single> singles{rows.single_of("m4", 9 + odds), rows.single_of("m0", 2 + odds)};
  const WeighedClaim found = claim_several(rows.inquiry(), rows.analysis, groups, singles);
  const Claim& claim = found.claim;
  const double all = std::exp(12) + std::exp(11) + std::exp(4) + std::exp(9) + std::exp(2);
  EXPECT_EQ(claim.named, 2u);
  ASSERT_THAT(ids_of(claim.causes), ElementsAre("m0", "m1"));
  EXPECT_NEAR(claim.causes[0].probability, (std::exp(12) + std::exp(11) + std::exp(2)) / all, 1e-9);
  EXPECT_NEAR(claim.causes[1].probability, std::exp(12) / all, 1e-9);
  const double lost = numerics::chi_squared_above(40, 1);
  EXPECT_NEAR(claim.causes[1].p_value, lost, 1e-6 * lost) << "what is lost without it";
  EXPECT_NEAR(claim.best->fit.chi2, 120, 1e-3);
  EXPECT_THAT(claim.ambiguity_set, ElementsAre("m0", "m1", "m2"));
  EXPECT_THAT(claim.alternatives, ElementsAre(Names({"m0", "m2"})));
  ASSERT_THAT(claim.rivals, SizeIs(2));
  EXPECT_NEAR(claim.rivals[1].fit.chi2, 130, 1e-3);
  ASSERT_TRUE(claim.best_rejected);
  EXPECT_EQ(claim.best_rejected->id, "m4") << "it leaves 150, and m2 + m3 160";
  EXPECT_THAT(found.directions, ElementsAre(rows.direction("m0"), rows.direction("m1")));
  EXPECT_EQ(found.explanations, 2u);
  EXPECT_FALSE(found.alone);
  EXPECT_EQ(found.correction, "");
}

TEST(ClaimOfSeveral, StandsAloneWhereNothingRivalsIt) {
  const Rows rows({50, 40, 30, 20});
  const double odds = log_odds_of_pair(2);
  const std::vector<Single> singles{rows.single_of("m0", 1 + odds), rows.single_of("m3", odds)};
  const WeighedClaim found = claim_several(
      rows.inquiry(), rows.analysis, {rows.group_with({"m0", "m1"}, 12), rows.group_with({"m1", "m2"}, 2)}, singles);
  EXPECT_TRUE(found.alone);
  EXPECT_EQ(found.explanations, 1u);
  EXPECT_THAT(found.claim.alternatives, IsEmpty());
  EXPECT_EQ(found.claim.best_rejected->id, "m1 + m2");
  // One of the causes by itself is not wrong, it is not all.
  const WeighedClaim beside = claim_several(rows.inquiry(), rows.analysis, {rows.group_with({"m0", "m1"}, 12)},
                                            {rows.single_of("m0", 1 + odds)});
  EXPECT_FALSE(beside.claim.best_rejected);
}

// A single that is likelier than a pair comes before it, and the best group before both.
TEST(ClaimOfSeveral, ListsItsRivalsLikeliestFirst) {
  const Rows rows({50, 40, 30, 20});
  const double odds = log_odds_of_pair(1);
  const Claim claim = claim_several(rows.inquiry(), rows.analysis,
                                    {rows.group_with({"m0", "m1"}, 10), rows.group_with({"m1", "m2"}, 9.5)},
                                    {rows.single_of("m3", 9.8 + odds)})
                          .claim;
  EXPECT_THAT(claim.alternatives, ElementsAre(Names{"m3"}, Names({"m1", "m2"})));
}

// Three have odds twice as long.
TEST(ClaimOfSeveral, PaysForEveryMember) {
  const Rows rows({50, 40, 30, 20});
  const double odds = log_odds_of_pair(1);
  const Claim claim = claim_several(rows.inquiry(), rows.analysis, {rows.group_with({"m0", "m1", "m2"}, 10)},
                                    {rows.single_of("m3", 9 + 2 * odds)})
                          .claim;
  EXPECT_EQ(claim.named, 3u);
  EXPECT_NEAR(claim.causes[0].probability, std::exp(10) / (std::exp(10) + std::exp(9)), 1e-9);
}

/// Two tests; "p" in each of them.
TEST(ClaimOfSeveral, TakesTheSameMechanismsElsewhereForNoOtherExplanation) {
  MadeUpCauses causes({2, 2}, Eigen::Vector4d(5, 4, 5, 4));
  causes.add({"p", Eigen::Vector4d(1, 0, 1, 0), {{"a"}, {"b"}}});
  causes.add({"q", Eigen::Vector4d(0, 1, 0, 1), {{"a"}, {"b"}}});
  causes.close();
  std::vector<Group> groups;
  for (const std::size_t place : {0u, 1u}) {
    groups.push_back(causes.group_of({causes.direction("p", place), causes.direction("q", place)}));
    groups.back().log_weight = 10;
  }
  Single far = causes.single("p");
  far.log_weight = 0;
  const WeighedClaim found = claim_several(causes.inquiry(), causes.analysis, groups, {far});
  EXPECT_TRUE(found.alone);
  EXPECT_THAT(found.claim.rivals, SizeIs(1));
  EXPECT_LE(found.claim.causes[0].probability, 1);
}

/// m2 would have to be 9, and 1 is plausible. With odds of twenty to one against it, it is still as likely as the pair.
struct BesideWhatNobodyBelieves : MadeUpCauses {
  explicit BesideWhatNobodyBelieves(double plausible) : MadeUpCauses({3}, Eigen::Vector3d(7, 6, 9)) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      MadeUp one{"m" + std::to_string(k), at_rows(3, {{k, 1}})};
      if (k == 2) one.declare = [plausible](MechanismFactory& factory) { factory.plausible_max = plausible; };
      add(std::move(one));
    }
    close();
  }
  [[nodiscard]] WeighedClaim claimed(bool clean) {
    Group pair = group_of({direction("m0"), direction("m1")});
    Single doubted = single("m2");
    pair.log_weight = 10;
    doubted.log_weight = 10 + log_odds_of_pair(1);
    return claim_several(inquiry(), analysis, {pair}, {doubted}, clean);
  }
};

TEST(ClaimOfSeveral, LeavesWhatNobodyBelievesOutBesideWhatLeavesNoise) {
  BesideWhatNobodyBelieves causes(500);
  EXPECT_FALSE(causes.claimed(true).alone) << "a plausible one is a rival";
  EXPECT_THAT(causes.claimed(true).claim.doubted, IsEmpty());

  BesideWhatNobodyBelieves doubtful(1);
  const WeighedClaim found = doubtful.claimed(true);
  EXPECT_TRUE(found.alone);
  EXPECT_THAT(found.claim.ambiguity_set, ElementsAre("m0", "m1"));
  EXPECT_NEAR(found.claim.causes.front().probability, 20.0 / 21, 1e-9);
  const Claim beside = doubtful.claimed(false).claim;
  EXPECT_THAT(beside.ambiguity_set, ElementsAre("m0", "m1", "m2"));
  EXPECT_THAT(beside.doubted, ElementsAre(Names{"m2"})) << "it stays in the set and is marked";
}

// Data of 3 in the second row: q = (1, 1) takes half of it by itself and p = (1, 0) nothing, and together all.
TEST(ClaimOfSeveral, SaysWhichMemberMayOnlyCorrectAShape) {
  MadeUpCauses causes({2}, Eigen::Vector2d(0, 3));
  causes.add({"p", Eigen::Vector2d(1, 0)});
  causes.add({"q", Eigen::Vector2d(1, 1)});
  causes.close();
  const std::vector<Group> pair{causes.group_of({causes.direction("q"), causes.direction("p")})};
  std::vector<Single> singles{causes.single("q"), causes.single("p")};
  EXPECT_EQ(claim_several(causes.inquiry(), causes.analysis, pair, singles).correction, "p");
  singles[1].best.reset();  // by its score then
  EXPECT_EQ(claim_several(causes.inquiry(), causes.analysis, pair, singles).correction, "p");
  singles.pop_back();
  EXPECT_EQ(claim_several(causes.inquiry(), causes.analysis, pair, singles).correction, "") << "nobody knows";
}

// Of 100, 16 and 14 alone are next to nothing below 15.
TEST(ClaimOfSeveral, DrawsThatLineAtFifteenPercent) {
  for (const auto& [small, expected] : {std::pair{16.0, ""}, std::pair{14.0, "m1"}}) {
    const Rows rows({100 - small, small});
    const std::vector<Single> singles{rows.single("m0"), rows.single("m1")};
    EXPECT_EQ(claim_several(rows.inquiry(), rows.analysis, {rows.group_with({"m0", "m1"}, 10)}, singles).correction,
              expected);
  }
  const Rows rows({5, 90, 4});
  const std::vector<Single> singles{rows.single("m0"), rows.single("m1"), rows.single("m2")};
  EXPECT_EQ(claim_several(rows.inquiry(), rows.analysis, {rows.group_with({"m0", "m1", "m2"}, 10)}, singles).correction,
            "m2")
      << "the least";
}

}  // namespace
}  // namespace tunica::diagnosis::claims_test
