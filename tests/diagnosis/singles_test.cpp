// SPDX-License-Identifier: Apache-2.0
// Every mechanism as the only explanation: what is fitted, from where, and the marginal likelihood that comes of it.
#include "diagnosis/naming/singles.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;
using Side = MechanismFactory::Side;

std::size_t fitted_of(const std::vector<Single>& singles) {
  return static_cast<std::size_t>(
      std::count_if(singles.begin(), singles.end(), [](const Single& single) { return single.best.has_value(); }));
}

TEST(LogSum, IsTheLogarithmOfTheSum) {
  EXPECT_EQ(log_sum({}), -INFINITY);
  EXPECT_EQ(log_sum({-INFINITY, -INFINITY}), -INFINITY) << "and no NaN";
  EXPECT_DOUBLE_EQ(log_sum({std::log(2.0), std::log(3.0), std::log(5.0)}), std::log(10.0));
  EXPECT_DOUBLE_EQ(log_sum({1000, 1000 + std::log(3.0)}), 1000 + std::log(4.0)) << "no sum of exponentials";
}

// Gains of 4, 1 and 0.25 of one row each; nothing where the data go the other way.
TEST(Singles, AreWeighedByTheirGainAndTheirSides) {
  MadeUpCauses causes({5}, (Eigen::VectorXd(5) << 2, 1, 0.5, -3, 2).finished());
  causes.add({"unseen", at_rows(5, {})});
  causes.add({"both", at_rows(5, {{0, 3}})});
  causes.add({"large", at_rows(5, {{4, 1}}), {{"a"}}, Side::positive});
  causes.add({"one", at_rows(5, {{1, 2}}), {{"a"}}, Side::positive});
  causes.add({"small", at_rows(5, {{2, 1}}), {{"a"}}, Side::positive});
  const auto at_null = [](MechanismFactory& factory) { factory.parameters.front().min = 0; };
  causes.add({"other_way", at_rows(5, {{3, 1}}), {{"a"}}, Side::positive, 1, 0, {}, at_null});
  causes.close();
  const auto normal_below = [](double t) { return 0.5 * std::erfc(-t / std::sqrt(2.0)); };
  const std::vector<std::pair<std::string, double>> expected{{"large", 2 + std::log(2 * normal_below(2))},
                                                             {"both", 2.0},
                                                             {"one", 0.5 + std::log(2 * normal_below(1))},
                                                             {"small", 0.125 + std::log(2 * normal_below(0.5))},
                                                             {"other_way", 0.0}};
  const std::vector<Single> singles = fit_singles(causes.inquiry(), causes.analysis);
  ASSERT_THAT(singles, SizeIs(5)) << "unseen leaves no trace";
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(causes.analysis.hypotheses.candidates[singles[k].candidate].id, expected[k].first) << "likeliest first";
    EXPECT_NEAR(singles[k].log_weight, expected[k].second, 1e-3) << expected[k].first;
    EXPECT_EQ(causes.id_of(singles[k].direction), expected[k].first);
    ASSERT_TRUE(singles[k].best);
    EXPECT_EQ(singles[k].best->additions.front().id, expected[k].first);
  }
}

// An amplitude of 5 at most explains of a row of √T what is left beyond 5. Places of 100 and 96 are fitted, that of 93,
// more than 6 below the best, is not: it is taken to gain the share of the best one, 75 of 100.
TEST(Singles, TakeWhatWasNotFittedToGainNoLargerPartOfItsScore) {
  OneRowEach causes({96, 93, 100});
  causes.add_everywhere("m", {1, 1, 1}, 5);
  causes.close();
  const std::vector<Single> singles = causes.run();
  EXPECT_EQ(causes.jobs(), 2u);
  const double second = 96 - std::pow(std::sqrt(96) - 5, 2);
  EXPECT_NEAR(singles[0].log_weight,
              std::log((std::exp(75 / 2.0) + std::exp(second / 2) + std::exp(0.75 * 93 / 2)) / 3), 1e-3);
  EXPECT_EQ(singles[0].direction, causes.direction("m", 2));
  EXPECT_NEAR(singles[0].best->fit.chi2, 96 + 93 + 25, 1e-3);
}

TEST(Singles, DoSoHoweverSmallTheScores) {
  OneRowEach causes({0.64, 0.6, 0.5});
  causes.add_everywhere("m", {1, 1, 1}, 0.4);
  causes.close();
  causes.request.quick = true;
  const std::vector<Single> singles = causes.run();
  EXPECT_EQ(causes.jobs(), 2u);
  const double second = 0.6 - std::pow(std::sqrt(0.6) - 0.4, 2);
  EXPECT_NEAR(singles[0].log_weight,
              std::log((std::exp(0.48 / 2) + std::exp(second / 2) + std::exp(0.75 * 0.5 / 2)) / 3), 1e-5);
}

// A nuisance parameter explains 50 more where the mechanism is fitted; the place that is not fitted gains its score.
TEST(Singles, TakeWhatWasNotFittedToGainNoMoreThanItsScore) {
  MadeUpCauses causes({2, 1}, Eigen::Vector3d(10, std::sqrt(50), std::sqrt(93)));
  causes.add({"m", Eigen::Vector3d(1, 0, 1), {{"a"}, {"b"}}, Side::both, 1, 0, {{"w", Eigen::Vector3d(0, 1, 0)}}});
  causes.close();
  const std::vector<Single> singles = fit_singles(causes.inquiry(), causes.analysis);
  EXPECT_NEAR(singles[0].log_weight, std::log((std::exp(150 / 2.0) + std::exp(93 / 2.0)) / 2), 1e-3);
}

// Of 100, 94.5 and 93.5 the last one is more than 6 below the first.
TEST(Singles, AreFittedInTheirFourBestPlacesOrWhereItIsQuickInTwo) {
  OneRowEach near({96, 95, 100, 98, 99, 97});
  near.add_everywhere("m", {1, 1, 1, 1, 1, 1});
  near.close();
  const std::vector<Single> four = near.run();
  EXPECT_EQ(near.jobs(), 4u);
  EXPECT_EQ(four[0].direction, near.direction("m", 2));
  near.request.quick = true;
  near.run();
  EXPECT_EQ(near.jobs(), 2u);

  OneRowEach apart({93.5, 94.5, 100});
  apart.add_everywhere("m", {1, 1, 1});
  apart.close();
  apart.run();
  EXPECT_EQ(apart.jobs(), 2u);
}

TEST(Singles, AreFittedOnceInAPlace) {
  OneRowEach causes({100, 99});
  causes.add({"m", at_rows(2, {{0, 1}, {1, 1}}), {{"a"}, {"a"}, {"b"}, {"a"}}});
  causes.close();
  causes.run();
  EXPECT_EQ(causes.jobs(), 2u);
}

// The first place is likelier by its score, 100, but for an amplitude of 10 where 5 is the most.
TEST(Singles, KeepTheirBestRefit) {
  OneRowEach causes({98, 100});
  causes.add_everywhere("m", {4, 1}, 5);
  causes.add({"small", at_rows(2, {{0, 1}, {1, 0.5}}), {{"a", "b"}}});
  causes.close();
  const std::vector<Single> singles = causes.run();
  EXPECT_EQ(singles[1].direction, causes.direction("m", 0));
  EXPECT_EQ(singles[1].best->additions.front().place.tests, std::vector<std::string>{"a"});
  EXPECT_NEAR(singles[1].best->fit.chi2, 100, 1e-3);
}

TEST(Singles, AreAllFittedUnlessItIsQuick) {
  OneRowEach causes({95, 96, 97, 98, 99, 100, 101, 102, 103, 104, 105, 106});
  causes.add_each(12);
  causes.close();
  EXPECT_EQ(fitted_of(causes.run()), 12u);
  EXPECT_EQ(causes.jobs(), 12u);
  causes.request.quick = true;
  const std::vector<Single> quick = causes.run();
  EXPECT_EQ(fitted_of(quick), 10u);
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(causes.id_of(quick[k].direction), fmt::format("m{}", 11 - k));
    EXPECT_EQ(quick[k].best.has_value(), k < 10) << k;
    EXPECT_NEAR(quick[k].log_weight, (106 - static_cast<double>(k)) / 2, 1e-3) << "by its score without a refit";
  }
}

// Weights are half of these. Quick, the first four are fitted, and those within 9 of the first.
TEST(Singles, FarBehindAreNotFittedWhereItIsQuick) {
  for (const auto& [squares, expected] : {std::pair{std::vector<double>{77, 78, 81, 80, 79, 100}, 4u},
                                          std::pair{std::vector<double>{81, 98, 97, 99, 83, 100}, 5u}}) {
    OneRowEach causes(squares);
    causes.add_each(6);
    causes.close();
    EXPECT_EQ(fitted_of(causes.run()), 6u);
    causes.request.quick = true;
    EXPECT_EQ(fitted_of(causes.run()), expected);
  }
}

// The best by its score cannot reach its amplitude, and what cannot be evaluated has no refit: both are likely, and
// behind.
TEST(Singles, ThatAreFittedComeFirstLikeliestFirst) {
  OneRowEach causes({100, 99, 98});
  causes.add({"bounded", at_rows(3, {{0, 1}}), {{"a"}}, Side::both, 1, 0, {}, [](MechanismFactory& factory) {
                factory.parameters.front().max = 1;
              }});
  MadeUp failing{"failing", at_rows(3, {{1, 1}}), {{"b"}}};
  failing.by = [](double distance) { return distance == 0 ? 0 : NAN; };
  causes.add(failing);
  causes.add({"good", at_rows(3, {{2, 1}}), {{"c"}}});
  causes.close();
  const std::vector<Single> singles = causes.run();
  std::vector<std::string> ids;
  for (const Single& single : singles) ids.push_back(causes.id_of(single.direction));
  EXPECT_THAT(ids, ElementsAre("good", "bounded", "failing"));
  EXPECT_NEAR(singles[0].log_weight, 49, 1e-3);
  EXPECT_NEAR(singles[1].log_weight, (100 - 81) / 2.0, 1e-3);
  EXPECT_NEAR(singles[2].log_weight, 49.5, 1e-9);
  EXPECT_FALSE(singles[2].best);
}

}  // namespace
}  // namespace tunica::diagnosis
