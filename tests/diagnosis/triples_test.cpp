// SPDX-License-Identifier: Apache-2.0
// Which mechanisms are fitted three at a time, on data of which every gain is a sum of squares.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"
#include "diagnosis/naming/groups.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAreArray;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;
using Side = MechanismFactory::Side;

/// Mechanisms of one row each, "m0" that explains most first, whatever their order in the catalogue. What they explain
/// are these squares; "m2" goes one way, and down.
struct RankedRows : MadeUpCauses {
  explicit RankedRows(const std::vector<double>& by_rank)
      : MadeUpCauses(
            {static_cast<int>(by_rank.size())},
            Eigen::Map<const Eigen::VectorXd>(by_rank.data(), static_cast<Eigen::Index>(by_rank.size())).cwiseSqrt()) {
    const auto size = static_cast<Eigen::Index>(by_rank.size());
    for (Eigen::Index k = 0; k < size; ++k) {
      const Eigen::Index rank = (7 * k + 3) % size;  // 7 and the size have no common divisor
      const std::string id = fmt::format("m{}", rank);
      if (rank == 2)
        add({id, at_rows(size, {{rank, -2}}), {{"a"}}, Side::positive, -1});
      else
        add({id, at_rows(size, {{rank, 1}})});
    }
    close();
  }
  /// These two, fitted; as fit_pairs() would hand them on.
  [[nodiscard]] Group pair(const std::string& first, const std::string& second) const {
    return group_of({direction(first), direction(second)});
  }
};

// Whatever comes beside a pair explains the square of its row. The first pair takes the six best of the rest, the next
// two the three best, the fourth none. Then 0 1 2 is the best; in the place of 0 and of 1 also 4 is tried.
TEST(Triples, AreThePairsAndWhatExplainsMostOfTheirRests) {
  const std::vector<double> squares{420, 419, 417.9, 416.7, 415.4, 414, 412.5, 410.9, 409.2, 407.4};
  RankedRows causes(squares);
  const std::vector<Group> pairs{causes.pair("m0", "m1"), causes.pair("m2", "m3"), causes.pair("m4", "m5"),
                                 causes.pair("m6", "m7")};
  std::vector<std::string> expected;
  for (const char* third : {"2", "3", "4", "5", "6", "7"}) expected.push_back(std::string("m0 m1 m") + third);
  for (const char* third : {"0", "1", "4"}) expected.push_back(std::string("m2 m3 m") + third);
  for (const char* third : {"0", "1", "2"}) expected.push_back(std::string("m4 m5 m") + third);
  expected.insert(expected.end(), {"m1 m2 m4", "m0 m2 m4"});
  std::map<std::string, double> weight;
  for (const std::string& names : expected) {
    for (std::size_t at = 1; at < names.size(); at += 3) {
      const auto rank = static_cast<std::size_t>(names[at] - '0');
      weight[names] += squares[rank] / 2 + (rank == 2 ? std::log(2) : 0);
    }
  }
  std::stable_sort(expected.begin(), expected.end(),
                   [&](const auto& a, const auto& b) { return weight[a] > weight[b]; });

  const auto groups = fit_triples(causes.inquiry(), causes.analysis, pairs);
  EXPECT_THAT(causes.names_of(groups), ElementsAreArray(expected)) << "best first";
  for (const Group& group : groups) {
    EXPECT_NEAR(group.log_weight, weight[causes.names_of(group)], 1e-4);
    EXPECT_THAT(group.losses, SizeIs(3));
    ASSERT_TRUE(group.begun_from);
    EXPECT_THAT(group.begun_from->additions, SizeIs(2));
    EXPECT_THAT(group.additions, SizeIs(3));
    EXPECT_THAT(group.amplitudes, SizeIs(3));
  }
  const Group& best = causes.group_named(groups, "m0 m1 m2");
  EXPECT_EQ(best.additions.back().id, "m2");
  EXPECT_NEAR(best.amplitudes.back(), -std::sqrt(417.9) / 2, 1e-3);
  EXPECT_NEAR(best.linear_gain, pairs[0].linear_gain + 417.9 + 2 * std::log(2), 1e-3);
}

TEST(Triples, AreNoneWithoutPairs) {
  RankedRows causes({420, 419, 418, 417, 416, 415, 414, 413, 412, 411});
  EXPECT_THAT(fit_triples(causes.inquiry(), causes.analysis, {}), IsEmpty());
}

// Whatever has 8 or 9 in it lies 180 of ln w below the best; after the six likeliest nobody asks for it.
TEST(Triples, FarBelowTheBestAreNotAskedFor) {
  RankedRows causes({420, 419, 418, 417, 416, 415, 414, 413, 50, 49});
  const std::vector<Group> pairs{causes.pair("m0", "m1"), causes.pair("m8", "m9")};
  for (const std::string& names : causes.names_of(fit_triples(causes.inquiry(), causes.analysis, pairs)))
    EXPECT_THAT(names, ::testing::Not(::testing::ContainsRegex("m8|m9")));
}

// m shows in three tests. A second one may stand beside it where several of it say more, a third one never.
TEST(Triples, HaveTwoOfAMechanismAtMost) {
  MadeUpCauses causes({2, 2, 2}, Eigen::VectorXd::LinSpaced(6, 20, 20.5));
  const auto declare = [](MechanismFactory& factory) { factory.several = true; };
  causes.add({"m", at_rows(6, {{0, 1}, {2, 1}, {4, 1}}), {{"a"}, {"b"}, {"c"}}, Side::both, 1, 0, {}, declare});
  causes.add({"p", at_rows(6, {{1, 1}})});
  causes.add({"q", at_rows(6, {{3, 1}}), {{"b"}}});
  causes.close();
  Group two = causes.group_of({causes.direction("m", 0), causes.direction("m", 1)}, {"", "m_2"});
  EXPECT_THAT(causes.names_of(fit_triples(causes.inquiry(), causes.analysis, {{two}})),
              UnorderedElementsAre("m m p", "m m q", "m q p"));
  const Group one = causes.group_of({causes.direction("p"), causes.direction("m", 0)});
  const auto groups = fit_triples(causes.inquiry(), causes.analysis, {{one}});
  EXPECT_THAT(causes.names_of(groups), ::testing::IsSupersetOf({"p m m", "p m q"}));
  EXPECT_EQ(causes.group_named(groups, "p m m").refit->additions.back().as, "") << "in another test";
  EXPECT_EQ(causes.group_named(groups, "p m q").refit->additions.back().as, "");
}

// One stage begins where the one before ends.
TEST(Triples, FollowPairsInTheProgress) {
  RankedRows causes({420, 419, 418, 417, 416, 415, 414, 413, 412, 411});
  const std::vector<Single> singles = fit_singles(causes.inquiry(), causes.analysis);
  const auto stretch = [&causes] {
    std::sort(causes.reports.begin(), causes.reports.end());
    const std::pair ends{causes.reports.front().first, causes.reports.back().first};
    causes.reports.clear();
    return ends;
  };
  const auto [singles_from, singles_to] = stretch();
  EXPECT_DOUBLE_EQ(singles_from, 0.4);
  const std::vector<Group> found = fit_pairs(causes.inquiry(), causes.analysis, singles, -INFINITY);
  const auto [pairs_from, pairs_to] = stretch();
  EXPECT_DOUBLE_EQ(pairs_from, singles_to);
  EXPECT_DOUBLE_EQ(pairs_from, 0.55);
  ASSERT_THAT(found, ::testing::Not(IsEmpty()));
  const std::vector<Group> pairs{causes.pair("m0", "m1"), causes.pair("m2", "m3"), causes.pair("m4", "m5")};
  ASSERT_THAT(fit_triples(causes.inquiry(), causes.analysis, pairs), ::testing::Not(IsEmpty()));
  for (std::size_t k = 1; k < causes.reports.size(); ++k) EXPECT_EQ(causes.reports[k].second, causes.reports[0].second);
  std::vector<double> shares;
  for (const auto& [share, stage] : causes.reports) shares.push_back(share);
  const auto [triples_from, triples_to] = stretch();
  EXPECT_DOUBLE_EQ(triples_from, pairs_to);
  EXPECT_DOUBLE_EQ(triples_from, 0.63);
  EXPECT_DOUBLE_EQ(triples_to, 0.7);
  // The second part of the triples begins where the first one ends.
  EXPECT_EQ(std::count_if(shares.begin(), shares.end(), [](double share) { return std::abs(share - 0.67) < 1e-12; }),
            2);
}

}  // namespace
}  // namespace tunica::diagnosis
