// SPDX-License-Identifier: Apache-2.0
// Where, and at which times, a mechanism is looked for.
#include "diagnosis/hypotheses/places.hpp"

#include <cmath>

#include <gmock/gmock.h>

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

}  // namespace
}  // namespace tunica::diagnosis
