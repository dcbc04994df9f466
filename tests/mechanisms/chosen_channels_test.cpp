// SPDX-License-Identifier: Apache-2.0
// Errors of the channel, and of the rows, that the options `channel` and `rows` name; and of every diameter.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subject.hpp"

namespace tunica::testing::chosen_channels_test {
namespace {

using Values = std::vector<double>;
using ::testing::HasSubstr;

const Values stretches{1.0, 1.1, 1.2, 1.3, 1.5};
const std::vector<std::string> both{"transverse_stretch", "stress"};

Options target(const std::string& channel, const std::string& rows = "") {
  Options options;
  if (!channel.empty()) options.set("channel", channel);
  if (!rows.empty()) options.set("rows", rows);
  return options;
}

/// What the mechanism adds to a strip at this amplitude.
Values added(const std::string& mechanism, double amplitude, const Options& options, const StripSetup& setup) {
  const auto bare = make_strip(stretches, setup);
  const auto with = wrapped_test(mechanism, make_strip(stretches, setup), options);
  const auto material = make_model("gho");
  Values a(bare->rows().channels.size() * stretches.size()), b(a.size());
  EXPECT_TRUE(bare->predict({*material, set_s, Values{0}}, {a, {}, {}, {}}).ok());
  EXPECT_TRUE(with->predict({*material, set_s, Values{0, amplitude}}, {b, {}, {}, {}}).ok());
  for (std::size_t i = 0; i < a.size(); ++i) b[i] -= a[i];
  return b;
}

void expect_near(const Values& found, const Values& expected) {
  EXPECT_THAT(found, ::testing::Pointwise(::testing::DoubleNear(1e-13), expected));
}

TEST(SignalDrift, GrowsWithTheRowsWhereThereIsNoTime) {
  expect_near(added("signal_drift", 8, target(""), {}), {0, 2, 4, 6, 8});
  expect_near(added("signal_drift", 8, target("stress"), {.channels = both}), {0, 0, 0, 0, 0, 0, 2, 4, 6, 8});
}

TEST(SignalDrift, GrowsWithTimeWhereThereIs) {
  expect_near(added("signal_drift", 8, target(""), {.time = {10, 11, 11, 20, 30}}), {0, 0.4, 0.4, 4, 8});
}

TEST(Outliers, ShiftTheRowsThatAreNamed) {
  const StripSetup strip{.channels = both};
  expect_near(added("outliers", -3, target("stress", "1:4:2"), strip), {0, 0, 0, 0, 0, 0, -3, 0, -3, 0});
  expect_near(added("outliers", 0.1, target("transverse_stretch", "3:"), strip), {0, 0, 0, .1, .1, 0, 0, 0, 0, 0});
  expect_near(added("outliers", 2, target("", ":2"), {}), {2, 2, 0, 0, 0});
  expect_near(added("outliers", 2, target("", "::3"), {}), {2, 0, 0, 2, 0});
  expect_near(added("outliers", 2, target("", "4:99"), {}), {0, 0, 0, 0, 2});
  expect_near(added("outliers", 2, target(""), {}), {2, 2, 2, 2, 2});
}

TEST(ChosenChannels, HaveAmplitudesInTheirOwnUnit) {
  const auto unit = [](std::unique_ptr<tunica::Test> test, const std::string& channel) {
    const Parameter own = wrapped_test("signal_drift", std::move(test), target(channel))->describe().parameters.back();
    EXPECT_EQ(own.min, -own.max);
    return std::pair(own.unit, own.max);
  };
  EXPECT_EQ(unit(make_strip(stretches), "stress"), std::pair(std::string("kPa"), 100.0));
  EXPECT_EQ(unit(make_test("thick_wall_pressurisation"), "axial_force"), std::pair(std::string("mN"), 1000.0));
  EXPECT_EQ(unit(make_test("thick_wall_pressurisation"), "inner_diameter"), std::pair(std::string("mm"), 5.0));
  EXPECT_EQ(unit(make_test("thick_wall_pressurisation"), "outer_diameter_stretch"), std::pair(std::string("1"), 0.5));
}

/// true = measured (1 + γ) of each diameter, the force is left alone.
TEST(DiameterScaleError, ActsOnEveryDiameter) {
  const auto material = make_model("gho");
  const auto bare = make_test("thick_wall_pressurisation");
  const auto with = wrapped_test("diameter_scale_error", make_test("thick_wall_pressurisation"));
  Values a(12), b(12);
  ASSERT_TRUE(bare->predict({*material, set_s, bare_tube}, {a, {}, {}, {}}).ok());
  ASSERT_TRUE(with->predict({*material, set_s, Values{0, 0, 0, 0, 1, 0.05}}, {b, {}, {}, {}}).ok());
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(b[i] * (i < 8 ? 1.05 : 1), a[i], 1e-13 * a[i]);
}

std::string refusal(const std::string& mechanism, std::unique_ptr<Test> base, const Options& options) {
  try {
    static_cast<void>(wrapped_test(mechanism, std::move(base), options));
  } catch (const InputError& problem) {
    return problem.what();
  }
  return "";
}
std::string refusal(const std::string& mechanism, const Options& options) {
  return refusal(mechanism, make_strip(stretches, {.channels = both}), options);
}

TEST(ChosenChannels, SayWhichThereAre) {
  for (const char* mechanism : {"signal_drift", "outliers"}) {
    EXPECT_THAT(
        refusal(mechanism, target("")),
        HasSubstr(std::string(mechanism) +
                  ": the test has several channels; say which one with \"channel\": transverse_stretch, stress"));
    EXPECT_THAT(refusal(mechanism, target("force")),
                HasSubstr("\"channel\" is 'force', which the test's data do not have; expected one of: "
                          "transverse_stretch, stress"));
  }
}

TEST(DiameterScaleError, NeedsADiameter) {
  EXPECT_THAT(refusal("diameter_scale_error", make_tube({1, 8}, {.channels = {"axial_force"}}), {}),
              HasSubstr("diameter_scale_error: the test's data have no channel 'outer_diameter', 'inner_diameter', "
                        "'outer_diameter_stretch', 'inner_diameter_stretch', which is what the mechanism shifts; map a "
                        "column to one of them, or take the mechanism out"));
}

TEST(Outliers, RefuseWhatIsNoRowRange) {
  for (const char* rows : {"", "3", "a:b", "1:2:3:4", "0:4:0", "-1:2", "every"}) {
    Options options = target("stress");
    options.set("rows", std::string(rows));
    EXPECT_THAT(refusal("outliers", options),
                HasSubstr("outliers: \"rows\" is '" + std::string(rows) +
                          "'; expected \"all\", \"first:last\" or \"first:last:step\" as in \"0:240:6\""));
  }
  for (const char* rows : {"5:9", "3:3"})
    EXPECT_THAT(refusal("outliers", target("stress", rows)), HasSubstr("which is none of the test's rows 0 to 4"));
}

TEST(SignalDrift, NeedsATestThatLasts) {
  EXPECT_THAT(refusal("signal_drift", make_strip({1.1}), {}),
              HasSubstr("signal_drift: the test's only row lasts no time, and nothing can drift; expected two rows or "
                        "more; take the mechanism out"));
  EXPECT_THAT(refusal("signal_drift", make_strip({1.1, 1.2}, {.time = {3, 3}}), {}),
              HasSubstr("signal_drift: the test's recording lasts no time, and nothing can drift; expected a time that "
                        "goes on"));
}

}  // namespace
}  // namespace tunica::testing::chosen_channels_test
