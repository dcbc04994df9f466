// SPDX-License-Identifier: Apache-2.0
// Which pairs of mechanisms are fitted together, and what each gains, on data of which every gain is a sum of squares.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"
#include "diagnosis/naming/groups.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;
using Side = MechanismFactory::Side;

constexpr double no_floor = -INFINITY;
constexpr double fit_ends = 1e-4;  ///< of |r|²: a fit ends where a step promises 1e-6

/// A mechanism of each name, that shows in the row of its number alone; the data show these values there.
MadeUpCauses& with_rows(MadeUpCauses& causes, const std::vector<std::string>& ids, Eigen::Index size) {
  for (std::size_t k = 0; k < ids.size(); ++k) causes.add({ids[k], at_rows(size, {{static_cast<Eigen::Index>(k), 1}})});
  return causes;
}

TEST(Pairs, OddsAreOneInTenOverThePairsPerMechanism) {
  EXPECT_DOUBLE_EQ(log_odds_of_pair(3), std::log(0.1)) << "three mechanisms, three pairs";
  EXPECT_DOUBLE_EQ(log_odds_of_pair(4), std::log(0.1 / 1.5)) << "four mechanisms, six pairs";
  EXPECT_NEAR(log_odds_of_pair(21), std::log(0.01), 1e-12);
  EXPECT_DOUBLE_EQ(log_odds_of_pair(2), std::log(0.1)) << "one pair of two is no advantage";
  EXPECT_DOUBLE_EQ(log_odds_of_pair(1), std::log(0.1));
}

// p = e0, q = 0.6 e0 + 0.8 e1 of length 2; the data are 3 p + 5 q, that is 9 e0 + 8 e1. A third one is the best by
// itself.
TEST(Pairs, GainWhatTwoAmplitudesTogetherExplain) {
  MadeUpCauses causes({4}, Eigen::Vector4d(9, 8, 20, 0));
  causes.add({"third", Eigen::Vector4d(0, 0, 1, 0)});
  causes.add({"p", Eigen::Vector4d(1, 0, 0, 0)});
  causes.add({"q", Eigen::Vector4d(1.2, 1.6, 0, 0), {{"a"}}, Side::positive});
  causes.add({"down", Eigen::Vector4d(0, 0, 0, 2), {{"a"}}, Side::positive, -1});
  causes.close();
  const auto groups = fit_pairs(causes.inquiry(), causes.analysis, {causes.single("third")}, no_floor);
  const Group& pair = causes.group_named(groups, "p q");
  ASSERT_THAT(pair.additions, SizeIs(2));
  EXPECT_EQ(pair.additions[0].id, "p");
  EXPECT_EQ(pair.additions[1].id, "q");
  EXPECT_TRUE(pair.additions[0].as.empty());
  EXPECT_EQ(pair.begun_from, nullptr);
  EXPECT_NEAR(pair.amplitudes.at(0), 3, 1e-12);
  EXPECT_NEAR(pair.amplitudes.at(1), 5, 1e-12);
  EXPECT_NEAR(pair.linear_gain, 81 + 64 + 2 * std::log(2), 1e-9) << "all of the two rows; q goes one way";
  EXPECT_NEAR(pair.log_weight, (81 + 64) / 2.0 + std::log(2), fit_ends);
  ASSERT_TRUE(pair.refit);
  EXPECT_NEAR(pair.refit->fit.chi2, 400, fit_ends);
  // Without q, p explains 81; without p, (0.6 · 9 + 0.8 · 8)² = 139.24.
  EXPECT_THAT(pair.losses,
              ElementsAre(::testing::DoubleNear(145 - 139.24, fit_ends), ::testing::DoubleNear(64, fit_ends)));
}

// Amplitudes below the null of a mechanism that goes down, at half the size for twice the effect.
TEST(Pairs, HaveAmplitudesOnTheSideOfTheirMechanism) {
  MadeUpCauses causes({3}, Eigen::Vector3d(9, -8, 20));
  causes.add({"third", Eigen::Vector3d(0, 0, 1)});
  causes.add({"down", Eigen::Vector3d(0, 2, 0), {{"a"}}, Side::positive, -1});
  causes.add({"down_too", Eigen::Vector3d(-3, 0, 0), {{"a"}}, Side::positive, -1});
  causes.close();
  const auto groups = fit_pairs(causes.inquiry(), causes.analysis, {causes.single("third")}, no_floor);
  const Group& pair = causes.group_named(groups, "down down_too");
  EXPECT_NEAR(pair.amplitudes.at(0), -4, 1e-12);
  EXPECT_NEAR(pair.amplitudes.at(1), -3, 1e-12);
  EXPECT_NEAR(pair.linear_gain, 145 + 4 * std::log(2), 1e-9);
}

// Of p and q alike, the data 9 p + 8 q need both amplitudes on one side.
TEST(Pairs, LeaveOutWhatWouldHaveToGoTheOtherWay) {
  for (const double first : {9.0, 0.5, -9.0})
    for (const double second : {8.0, -0.5, -8.0})
      for (const bool p_one_sided : {false, true})
        for (const bool q_one_sided : {false, true}) {
          MadeUpCauses causes({3}, Eigen::Vector3d(first, second, 20));
          causes.add({"third", Eigen::Vector3d(0, 0, 1)});
          causes.add({"p", Eigen::Vector3d(1, 0, 0), {{"a"}}, p_one_sided ? Side::positive : Side::both});
          causes.add({"q", Eigen::Vector3d(0, 1, 0), {{"a"}}, q_one_sided ? Side::positive : Side::both});
          causes.close();
          const auto groups = fit_pairs(causes.inquiry(), causes.analysis, {causes.single("third")}, no_floor);
          std::vector<std::string> expected;
          if (first > 0 || !p_one_sided) expected.emplace_back("third p");
          if (second > 0 || !q_one_sided) expected.emplace_back("third q");
          if (expected.size() == 2) expected.emplace_back("p q");
          EXPECT_THAT(causes.names_of(groups), ::testing::UnorderedElementsAreArray(expected))
              << first << ' ' << second << ' ' << p_one_sided << q_one_sided;
        }
}

// Two at an angle whose squared sine is 0.0196 or 0.0225; the linearisation takes those for one.
TEST(Pairs, OfTwoThatAreOneAndTheSameAreNone) {
  for (const auto& [sine, expected] : {std::pair{0.14, false}, std::pair{0.15, true}}) {
    MadeUpCauses causes({4}, Eigen::Vector4d(9, 8, 200, 0));
    causes.add({"third", Eigen::Vector4d(0, 0, 1, 0)});
    causes.add({"p", Eigen::Vector4d(1, 0, 0, 0)});
    causes.add({"q", Eigen::Vector4d(std::sqrt(1 - sine * sine), sine, 0, 0)});
    causes.close();
    const auto groups = fit_pairs(causes.inquiry(), causes.analysis, {causes.single("third")}, no_floor);
    EXPECT_EQ(::testing::Value(causes.names_of(groups), ::testing::Contains("p q")), expected) << sine;
    EXPECT_THAT(causes.names_of(groups), ::testing::Contains("third p"));
  }
}

// Eight mechanisms of one row each. Pairs explain the squares of two rows, 400 and a little each.
TEST(Pairs, AreTheBestTwentyFourOrWhereItIsQuickEight) {
  const std::vector<std::string> ids{"m4", "m9", "m2", "m6", "m8", "m3", "m5", "m7"};
  const std::vector<double> squares{401.9, 411.2, 400, 405.1, 409.6, 400.7, 403.8, 407.3};
  for (const bool quick : {false, true}) {
    MadeUpCauses causes({8}, Eigen::Map<const Eigen::VectorXd>(squares.data(), 8).cwiseSqrt());
    with_rows(causes, ids, 8).close();
    causes.request.quick = quick;
    std::vector<std::pair<double, std::string>> all;
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t j = i + 1; j < 8; ++j) all.emplace_back(-squares[i] - squares[j], ids[i] + " " + ids[j]);
    std::sort(all.begin(), all.end());
    std::vector<std::string> expected;
    for (std::size_t k = 0; k < (quick ? 8u : 24u); ++k) expected.push_back(all[k].second);
    const auto groups = fit_pairs(causes.inquiry(), causes.analysis, {causes.single("m9")}, no_floor);
    EXPECT_THAT(causes.names_of(groups), ::testing::ElementsAreArray(expected)) << "best first";
  }
}

// b shows in four tests, 13, 12, 11 and 10 there; front explains the first two of them, c what shows in a fifth.
TEST(Pairs, TakeTheBestPlacesAloneAndBesideTheBestSingle) {
  Eigen::VectorXd beyond(5);
  beyond << 10, 11, 12, 13, 7;
  MadeUpCauses causes({1, 1, 1, 1, 1}, beyond);
  causes.add({"b", at_rows(5, {{0, 1}, {1, 1}, {2, 1}, {3, 1}}), {{"d"}, {"a"}, {"b"}, {"c"}}});
  causes.add({"front", at_rows(5, {{2, 12}, {3, 13}}), {{"c", "d"}}});
  causes.add({"c", at_rows(5, {{4, 1}}), {{"e"}}});
  causes.close();
  const auto groups = fit_pairs(causes.inquiry(), causes.analysis, {causes.single("front")}, no_floor);
  std::vector<std::string> found;
  for (const Group& group : groups) {
    std::string words = causes.names_of(group);
    for (const Addition& addition : group.additions)
      if (addition.id == "b") words += " in " + addition.place.tests.front();
    found.push_back(words);
  }
  EXPECT_THAT(found, UnorderedElementsAre("b front in b", "b front in a", "front c", "b c in d", "b c in c"))
      << "of two mechanisms the two best places";
  const Group& pair = groups.front();
  EXPECT_EQ(causes.names_of(pair), "b front");
  EXPECT_NEAR(pair.linear_gain, 144 + 169 + 121 + 2 * std::log(0.25), 1e-9) << "one place of four";
}

// In its best place b is one with `same`: the next best takes its place, and no third.
TEST(Pairs, TakeTwoPlacesOfAMechanism) {
  MadeUpCauses causes({1, 1, 1, 1}, Eigen::Vector4d(10, 11, 12, 30));
  causes.add({"b", at_rows(4, {{0, 1}, {1, 1}, {2, 1}}), {{"a"}, {"b"}, {"c"}}});
  causes.add({"front", at_rows(4, {{3, 1}}), {{"d"}}});
  causes.add({"same", at_rows(4, {{2, 1}}), {{"c"}}});
  causes.close();
  const auto groups = fit_pairs(causes.inquiry(), causes.analysis, {causes.single("front")}, no_floor);
  std::vector<std::string> places;
  for (const Group& group : groups)
    if (causes.names_of(group) == "b same") places.push_back(group.additions.front().place.tests.front());
  EXPECT_THAT(places, ElementsAre("b"));
}

// Pairs of 20 and 10, of 20 and 8, of 10 and 8: half of their squares are 250, 232 and 82.
TEST(Pairs, FarBelowTheFloorAreNotFitted) {
  MadeUpCauses causes({3}, Eigen::Vector3d(20, 10, 8));
  with_rows(causes, {"p", "q", "r"}, 3).close();
  const auto pairs_above = [&](double floor) {
    return causes.names_of(fit_pairs(causes.inquiry(), causes.analysis, {causes.single("p")}, floor));
  };
  EXPECT_THAT(pairs_above(84.9), ElementsAre("p q", "p r", "q r")) << "a score may underrate a refit by 3";
  EXPECT_THAT(pairs_above(85.1), ElementsAre("p q", "p r"));
  EXPECT_THAT(pairs_above(252.9), ElementsAre("p q"));
  EXPECT_THAT(pairs_above(253.1), IsEmpty());
}

TEST(Pairs, OfOneMechanismAreNoneUnlessSeveralOfItSayMore) {
  for (const bool several : {false, true}) {
    MadeUpCauses causes({2, 2, 2}, at_rows(6, {{0, 10}, {2, 11}, {4, 5}}));
    const auto declare = [several](MechanismFactory& factory) { factory.several = several; };
    causes.add({"m", at_rows(6, {{0, 1}, {2, 1}}), {{"a"}, {"b"}}, Side::both, 1, 0, {}, declare});
    causes.add({"other", at_rows(6, {{4, 1}}), {{"c"}}});
    causes.close();
    const auto groups = fit_pairs(causes.inquiry(), causes.analysis, {causes.single("m", 1)}, no_floor);
    if (!several) {
      EXPECT_THAT(causes.names_of(groups), ElementsAre("m other", "m other"));
      continue;
    }
    EXPECT_THAT(causes.names_of(groups), ElementsAre("m m", "m other", "m other"));
    EXPECT_TRUE(groups.front().refit->additions.at(0).as.empty());
    EXPECT_TRUE(groups.front().refit->additions.at(1).as.empty()) << "in another test";
    EXPECT_TRUE(groups.at(1).refit->additions.at(1).as.empty());
    EXPECT_NEAR(groups.front().linear_gain, 221 + 4 * std::log(0.5), 1e-3);
  }
}

}  // namespace
}  // namespace tunica::diagnosis
