// SPDX-License-Identifier: Apache-2.0
// The least amplitude that data would show: closed forms for mechanisms whose signatures are made by hand.
#include "diagnosis/prospects/detectable.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::SizeIs;
using Side = MechanismFactory::Side;

constexpr double power_80 = 0.8416;  // quantile of the normal distribution
constexpr double infinite = INFINITY;

Detectable of(const MadeUpCauses& causes, const std::string& id) {
  for (const Detectable& one : detectable(causes.inquiry(), causes.analysis))
    if (one.id == id) return one;
  ADD_FAILURE() << "nothing of " << id;
  return {};
}

/// √Λ of a candidate: its threshold, and what 80 % power asks for beyond it.
double root_of_needed(const MadeUpCauses& causes, std::size_t candidate) {
  return std::sqrt(causes.analysis.alarm.detector->threshold(candidate, causes.request.alpha)) + power_80;
}

TEST(DetectableAmplitude, IsWhatTheSignatureShowsWithEightyPerCentPower) {
  MadeUpCauses causes({4}, Eigen::VectorXd::Zero(4));
  causes.add({"long", at_rows(4, {{0, 3}, {1, -4}})});
  causes.add({"even", at_rows(4, {{2, 0.5}}), {{"a"}}, Side::even});
  causes.close();
  causes.calibrate_by_noise();
  const Detectable linear = of(causes, "long"), even = of(causes, "even");
  EXPECT_NEAR(linear.detectable, root_of_needed(causes, 0) / 5, 1e-9);
  EXPECT_NEAR(even.detectable, std::sqrt(root_of_needed(causes, 1) / 0.5), 1e-9);
  EXPECT_NEAR(linear.identifiable, linear.detectable, 1e-9) << "nothing is like it";
  EXPECT_EQ(linear.correlation, 0);
  EXPECT_EQ(linear.closest, "");
  EXPECT_EQ(linear.place.tests, std::vector<std::string>{"a"});
  EXPECT_NEAR(linear.retained, 1, 1e-12);
  EXPECT_EQ(linear.absent, "");
}

// Half of what "half" does, the free parameter does as well.
TEST(DetectableAmplitude, CountsWhatARefitLeaves) {
  MadeUpCauses causes({2}, Eigen::VectorXd::Zero(2));
  causes.free("a", -50, 50);
  causes.add({"half", at_rows(2, {{0, 2}})});
  causes.add({"all", Eigen::Vector2d(1, 1)});
  causes.add({"elsewhere", at_rows(2, {{1, 1}})});
  causes.close();
  causes.analysis.hypotheses.candidates[2].absence = Absence::absorbed;
  causes.analysis.hypotheses.candidates[2].absent = "it is not asked for";
  std::erase_if(causes.analysis.hypotheses.directions, [](const Direction& one) { return one.candidate == 2; });
  const Detectable half = of(causes, "half"), all = of(causes, "all"), told = of(causes, "elsewhere");
  EXPECT_NEAR(half.detectable, root_of_needed(causes, 0) / std::sqrt(2), 1e-9);
  EXPECT_NEAR(half.retained, std::sqrt(0.5), 1e-9);
  EXPECT_EQ(all.detectable, infinite);
  EXPECT_EQ(all.identifiable, infinite);
  EXPECT_EQ(all.absence, Absence::absorbed);
  EXPECT_EQ(all.absent, "a refit of the parameters absorbs it");
  EXPECT_EQ(all.unit, "kPa");
  EXPECT_EQ(all.reach, 500);
  EXPECT_EQ(told.absent, "it is not asked for");
}

// "p" is at 0.8 to "q", whichever way that goes, and at 0.6 to "r".
TEST(IdentifiableAmplitude, IsWhatTellsAMechanismFromTheOneMostLikeIt) {
  MadeUpCauses causes({3}, Eigen::VectorXd::Zero(3));
  causes.add({"p", Eigen::Vector3d(1, 0, 0)});
  causes.add({"r", Eigen::Vector3d(0.6, 0.8, 0)});
  causes.add({"q", Eigen::Vector3d(-0.8, 0, 0.6)});
  causes.close();
  causes.calibrate_by_noise();
  const Detectable p = of(causes, "p");
  EXPECT_EQ(p.closest, "q");
  EXPECT_NEAR(p.correlation, 0.8, 1e-12);
  EXPECT_NEAR(p.identifiable, std::sqrt(std::max(std::pow(root_of_needed(causes, 0), 2), 5.41 / 0.2)), 1e-9);
  EXPECT_GT(5.41 / 0.2, std::pow(root_of_needed(causes, 0), 2)) << "so that the likeness decides";
  EXPECT_EQ(of(causes, "q").closest, "p");
}

TEST(IdentifiableAmplitude, IsNoneWhereAnotherDoesTheSame) {
  for (const double off : {0.03, 0.06}) {  // cosines of 0.9995 and 0.998
    MadeUpCauses causes({2}, Eigen::VectorXd::Zero(2));
    causes.add({"p", Eigen::Vector2d(1, 0)});
    causes.add({"q", Eigen::Vector2d(std::cos(off), std::sin(off))});
    causes.close();
    EXPECT_EQ(std::isinf(of(causes, "p").identifiable), off < 0.05) << off;
    EXPECT_TRUE(std::isfinite(of(causes, "p").detectable));
  }
}

TEST(DetectableAmplitude, SaysWhatTheMechanismDeclares) {
  MadeUpCauses causes({2}, Eigen::VectorXd::Zero(2));
  const auto declare = [](MechanismFactory& factory) {
    factory.plausible_min = -2;
    factory.plausible_max = 7;
  };
  causes.add({"up", at_rows(2, {{0, 1}}), {{"a"}}, Side::positive, 1, 1, {}, declare});
  causes.add({"down", at_rows(2, {{1, 1}}), {{"a"}}, Side::both, 1, 4, {}, declare});
  causes.close();
  const Detectable up = of(causes, "up"), down = of(causes, "down");
  EXPECT_EQ(up.null, 1);
  EXPECT_TRUE(up.one_sided);
  EXPECT_FALSE(down.one_sided);
  EXPECT_EQ(up.reach, 6) << "from 1 to 7";
  EXPECT_EQ(down.reach, 6) << "from 4 to -2";
  causes.analysis.hypotheses.candidates[0].hypotheses[0].addition.range = AmplitudeRange{0, 30, -9, 90};
  EXPECT_EQ(of(causes, "up").reach, 29) << "what the data say comes first";
}

TEST(DetectableAmplitude, OfAChannelHasTheUnitOfTheChannel) {
  MadeUpCauses causes({2}, Eigen::VectorXd::Zero(2));
  causes.add({"m", at_rows(2, {{0, 1}}), {{"a"}}, Side::both, 1, 0, {}, [](MechanismFactory& factory) {
                factory.parameters.front().unit = "1";
              }});
  causes.close();
  EXPECT_EQ(of(causes, "m").unit, "1");
  Place& place = causes.analysis.hypotheses.candidates[0].hypotheses[0].addition.place;
  place.channel = "y";
  EXPECT_EQ(of(causes, "m").unit, "kPa");
  place.channel = "z";
  EXPECT_EQ(of(causes, "m").unit, "1") << "no such channel";
  place = {{"b"}, "y"};
  EXPECT_EQ(of(causes, "m").unit, "1") << "no such test";
}

/// A mechanism that shows in five tests by these lengths.
struct Places : OneRowEach {
  Places() : OneRowEach({0, 0, 0, 0, 0}) {
    add_everywhere("m", {1, 3, 2, 8, 9});
    close();
  }
  Hypothesis& hypothesis(std::size_t place) { return analysis.hypotheses.candidates[0].hypotheses[place]; }
  [[nodiscard]] std::string place() const { return of(*this, "m").place.tests.front(); }
};

TEST(DetectableAmplitude, IsThatOfThePlaceThatShowsMost) {
  Places causes;
  EXPECT_EQ(causes.place(), "e");
  causes.hypothesis(4).at_large = true;
  EXPECT_EQ(causes.place(), "d") << "at the null";
  causes.hypothesis(3).addition.place.row = 0;
  EXPECT_EQ(causes.place(), "b") << "in whole curves";
  causes.hypothesis(0).addition.range = AmplitudeRange{-10, 10000, -10, 10000};
  EXPECT_EQ(causes.place(), "a") << "by its largest plausible amplitude";
  causes.hypothesis(0).addition.range = AmplitudeRange{-10, infinite, -10, infinite};
  EXPECT_EQ(causes.place(), "b") << "of which there has to be one";
}

TEST(DetectableAmplitude, IsThatOfTheSettingInTheMiddle) {
  Places causes;
  for (std::size_t k = 0; k < 3; ++k) causes.hypothesis(k).addition.setting = {{"time", static_cast<double>(k)}};
  causes.hypothesis(3).addition.setting = causes.hypothesis(4).addition.setting = {{"time", 2}};
  EXPECT_EQ(causes.place(), "b") << "1, 3 and 9 of three settings";
  causes.hypothesis(4).at_large = true;
  causes.hypothesis(3).addition.setting = {{"time", 0}};
  causes.hypothesis(1).addition.setting = {{"time", 2}};
  EXPECT_EQ(causes.place(), "d") << "of two, 8 and 3, the larger one";
}

TEST(DetectableAmplitude, IsToldOfEveryMechanismInOrder) {
  MadeUpCauses causes({2}, Eigen::VectorXd::Zero(2));
  causes.add({"z", at_rows(2, {{0, 1}})});
  causes.add({"nothing", at_rows(2, {})});
  causes.add({"a", at_rows(2, {{1, 1}})});
  causes.close();
  const auto all = detectable(causes.inquiry(), causes.analysis);
  ASSERT_THAT(all, SizeIs(3));
  EXPECT_EQ(all[0].id, "z");
  EXPECT_EQ(all[1].id, "nothing");
  EXPECT_EQ(all[2].id, "a");
}

}  // namespace
}  // namespace tunica::diagnosis
