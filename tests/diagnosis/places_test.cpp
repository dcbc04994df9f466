// SPDX-License-Identifier: Apache-2.0
// Where, and at which times, a mechanism is looked for.
#include "diagnosis/hypotheses/places.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/search_bed.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

/// An amplitude, and nuisance parameters with these units, from 0.01 to 1000.
MechanismFactory with_nuisance(const std::vector<std::string>& units) {
  MechanismFactory mechanism;
  mechanism.parameters = {{"amplitude", "1", 0, 0, 1, Scale::linear, "", ""}};
  for (const std::string& unit : units)
    mechanism.parameters.push_back(
        {"tau_" + std::to_string(mechanism.parameters.size()), unit, 1, 0.01, 1000, Scale::log, "", ""});
  return mechanism;
}

TEST(SettingsToTry, SpreadOverTheClockOfTheData) {
  const auto settings = settings_to_try(with_nuisance({"1", "s"}), {0.5, 50});
  ASSERT_THAT(settings, SizeIs(6));
  for (std::size_t i = 0; i < 6; ++i) {
    ASSERT_THAT(settings[i], SizeIs(1));
    EXPECT_EQ(settings[i][0].first, "tau_2") << "the one in seconds";
    EXPECT_NEAR(settings[i][0].second, 0.5 * std::pow(100, static_cast<double>(i) / 5), 1e-12 * settings[i][0].second);
  }
}

TEST(SettingsToTry, StayWithinTheBoundsOfTheParameter) {
  const auto settings = settings_to_try(with_nuisance({"s"}), {1e-4, 1e5});
  EXPECT_NEAR(settings.front()[0].second, 0.01, 1e-15);
  EXPECT_NEAR(settings.back()[0].second, 1000, 1e-9);
}

TEST(SettingsToTry, ScanOneTimeOfSeveral) {
  const auto settings = settings_to_try(with_nuisance({"s", "s"}), {0.5, 50});
  ASSERT_THAT(settings, SizeIs(6));
  for (const auto& setting : settings) EXPECT_EQ(setting[0].first, "tau_1");
}

TEST(SettingsToTry, AreOneWhereNoClockIsReadOrNeeded) {
  for (const auto& [mechanism, clock] :
       {std::pair{with_nuisance({"s"}), Clock{}}, std::pair{with_nuisance({"1"}), Clock{0.5, 50}}}) {
    const auto settings = settings_to_try(mechanism, clock);
    ASSERT_THAT(settings, SizeIs(1));
    EXPECT_THAT(settings[0], IsEmpty());
  }
}

TEST(SettingsToTry, AreThoseThatTheMechanismNames) {
  MechanismFactory mechanism = with_nuisance({"s"});
  mechanism.scan = {{{"tau_1", 7}}, {{"tau_1", 8}}};
  EXPECT_EQ(settings_to_try(mechanism, {0.5, 50}), mechanism.scan);
}

TEST(Places, OfAMechanismAreWhatItDeclares) {
  MechanismFactory mechanism = with_nuisance({"1"});
  EXPECT_FALSE(needs_clock(mechanism));
  EXPECT_TRUE(needs_clock(with_nuisance({"1", "s"})));
  EXPECT_FALSE(takes(mechanism, "channel"));
  mechanism.options = {Option::choice("side", {"left", "right"}, "left", ""), Option::text("channel", "", "")};
  EXPECT_TRUE(takes(mechanism, "channel"));

  mechanism.stage = Stage::history;
  EXPECT_EQ(group_of(mechanism), CauseGroup::material);
  mechanism.stage = Stage::test;
  EXPECT_EQ(group_of(mechanism), CauseGroup::rig);
  mechanism.origin = MechanismFactory::Origin::material;
  EXPECT_EQ(group_of(mechanism), CauseGroup::material) << "residual stress acts on a test";
  mechanism.stage = Stage::energy;
  mechanism.origin = MechanismFactory::Origin::rig;
  EXPECT_EQ(group_of(mechanism), CauseGroup::rig);
}

TEST(Unloading, IsAFallOfATenthOfTheRangeFromTheLargestSoFar) {
  const auto unloading = [](const std::vector<double>& x) {
    SearchBed bed;
    bed.add("a", x);
    bed.add("other", {3, 1});
    return unloads(bed.assemble(), "a");
  };
  EXPECT_FALSE(unloading({0, 5, 10}));
  EXPECT_FALSE(unloading({0, 10, 9.1}));
  EXPECT_TRUE(unloading({0, 10, 8.9}));
  EXPECT_FALSE(unloading({100, 110, 109.1}));
  EXPECT_TRUE(unloading({100, 110, 108.9}));
  EXPECT_TRUE(unloading({5, 0, 10})) << "at once";
  EXPECT_TRUE(unloading({0, 10, 9.5, 8.9})) << "in two steps";
}

TEST(ClockOfTheData, HasTheShortestStepAndTheLongestTest) {
  SearchBed bed;
  bed.add("a", {1, 1.5, 2}).data.time_rate = 2;    // 0.25 s each
  bed.add("b", {1, 1.125, 3}).data.time_rate = 1;  // 0.125 s and 1.875 s
  bed.add("c", {1, 1.0625, 99});                   // nobody says when
  const Clock clock = clock_of(bed.experiment, bed.run, bed.shelf);
  EXPECT_NEAR(clock.shortest, 0.125, 1e-12);
  EXPECT_NEAR(clock.longest, 2, 1e-12);
  bed.run.tests = {"a"};
  EXPECT_NEAR(clock_of(bed.experiment, bed.run, bed.shelf).shortest, 0.25, 1e-12);
  EXPECT_NEAR(clock_of(bed.experiment, bed.run, bed.shelf).longest, 0.5, 1e-12);
  bed.run.tests = {"c"};
  EXPECT_EQ(clock_of(bed.experiment, bed.run, bed.shelf).longest, 0);
  EXPECT_EQ(clock_of(bed.experiment, bed.run, bed.shelf).shortest, INFINITY);
}

std::vector<std::string> tests_and_channels(const std::vector<Place>& places) {
  std::vector<std::string> words;
  for (const Place& place : places)
    words.push_back(place.tests.front() + (place.channel.empty() ? "" : "." + place.channel));
  return words;
}

TEST(SinglePlaces, AreTestsOrTheirChannelsThatAreFitted) {
  SearchBed bed;
  bed.add("a", {1, 2}, true);
  bed.add("b", {1, 2});
  bed.add("c", {1, 2}).type = "rough_curve";
  bed.add("held_out", {1, 2}).hold_out.all = true;
  MechanismFactory mechanism = acting("m", [](double, auto, const Options&) { return 0.0; });
  const auto places = [&] {
    return tests_and_channels(single_places(mechanism, bed.experiment, bed.run, bed.assemble()));
  };
  using ::testing::ElementsAre;
  EXPECT_THAT(places(), ElementsAre("a", "b", "c"));
  mechanism.applies_to = {"strip", "curve"};
  EXPECT_THAT(places(), ElementsAre("a", "b"));
  mechanism.options = {Option::text("channel", "", "")};
  EXPECT_THAT(places(), ElementsAre("a.y", "a.z", "b.y"));
}

// With a correlation c of neighbours a row is (e_i − c e_{i−1})/(σ √(1 − c²)); here σ = 0.5 and c = 0.6. Row 2 is held
// out, and its neighbours are then correlated by c².
TEST(SingleRowsOfACurve, AreWhitenedLikeTheResiduals) {
  SearchBed bed;
  bed.add("other", {1, 2});
  auto& entry = bed.add("a", {1, 2, 3, 4, 5}, true);
  entry.data.noise.front().second.correlation = 0.6;
  entry.hold_out.rows = data::RowRange{2, 3, 1};
  const assembly::Assembly base = bed.assemble();
  Hypothesis whole;
  whole.addition.place = {{"a"}, "y"};
  std::vector<Hypothesis> found;
  add_rows(whole, base, found);
  ASSERT_THAT(found, SizeIs(4));
  const double s = 2 / std::sqrt(1 - 0.36), gap = 2 / std::sqrt(1 - 0.36 * 0.36);
  const std::vector<std::vector<double>> expected{
      {2, -0.6 * s, 0, 0}, {0, s, -0.36 * gap, 0}, {0, 0, gap, -0.6 * s}, {0, 0, 0, s}};
  const std::vector<std::size_t> rows{0, 1, 3, 4};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(found[k].addition.place.row, rows[k]);
    EXPECT_EQ(found[k].addition.place.file_row, rows[k]);
    EXPECT_EQ(found[k].addition.place.channel, "y");
    ASSERT_EQ(found[k].signature.size(), 2 + 4 + 4);
    Eigen::VectorXd all = Eigen::VectorXd::Zero(10);
    for (Eigen::Index i = 0; i < 4; ++i) all[2 + i] = expected[k][static_cast<std::size_t>(i)];
    EXPECT_LT((found[k].signature - all).norm(), 1e-12) << found[k].signature.transpose();
  }
}

TEST(SingleRowsOfACurve, HaveTheNumberThatTheyHaveInTheFile) {
  SearchBed bed;
  bed.add("a", {3, 1, 2}).data.sorted = true;
  std::vector<Hypothesis> found;
  Hypothesis whole;
  whole.addition.place = {{"a"}, "y"};
  add_rows(whole, bed.assemble(), found);
  ASSERT_THAT(found, SizeIs(3));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(found[k].addition.place.file_row, (k + 1) % 3);
}

}  // namespace
}  // namespace tunica::diagnosis
