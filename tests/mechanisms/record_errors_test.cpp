// SPDX-License-Identifier: Apache-2.0
// What a record says of strips and sheets and is not so. The force is right, and the stress was computed from it and
// the recorded stretch.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subject.hpp"
#include "support/sheet.hpp"

namespace tunica::testing::record_errors_test {
namespace {

using Values = std::vector<double>;
using ::testing::HasSubstr;

Values values_of(const Test& test, const Values& own) {
  Values values(test.rows().channels.size() * test.rows().count);
  const auto material = make_model("gho");
  const Status status = test.predict({*material, set_s, own}, {values, {}, {}, {}});
  EXPECT_TRUE(status.ok()) << status.reason();
  return values;
}

/// Force over unloaded area at these stretches.
Values force_at(const Values& stretches) {
  return values_of(*make_strip(stretches, {.measure = "first_piola_kirchhoff"}), {0});
}

void expect_near(const Values& a, const Values& b, double relative) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], relative * std::abs(b[i])) << i;
}

/// A measure: recorded stress = P m^power.
struct Measure {
  const char* name;
  int power;
};

class RecordedStrip : public ::testing::TestWithParam<Measure> {
 protected:
  [[nodiscard]] std::unique_ptr<tunica::Test> strip(const std::string& mechanism) const {
    return wrapped_test(mechanism, make_strip(recorded, {.measure = GetParam().name}));
  }
  [[nodiscard]] Values stress(Values force) const {
    for (std::size_t i = 0; i < force.size(); ++i) force[i] *= std::pow(recorded[i], GetParam().power);
    return force;
  }
  const Values recorded{1.02, 1.1, 1.3, 1.5};
};

TEST_P(RecordedStrip, IsPulledFromAnotherZeroOfTheDisplacement) {
  Values truth = recorded;
  for (double& stretch : truth) stretch += 0.03;
  expect_near(values_of(*strip("displacement_offset"), {0, 0.03}), stress(force_at(truth)), 1e-9);
}

TEST_P(RecordedStrip, HasForceAndLengthFromItsPreloadOn) {
  Values truth = recorded, force = force_at(truth);
  for (double& stretch : truth) stretch *= 1.04;
  force = force_at(truth);
  for (double& one : force) one -= force_at({1.04}).front();
  expect_near(values_of(*strip("zeroed_at_preload"), {0, 0.04}), stress(force), 1e-9);
}

TEST_P(RecordedStrip, IsStretchedLessByWhatTheMachineTakes) {
  constexpr double compliance = 4e-4;
  Values truth = recorded;
  for (double& stretch : truth) {  // bisection of λ + a P(λ) = m
    double low = 1, high = stretch;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (middle + compliance * force_at({middle}).front() < stretch ? low : high) = middle;
    }
    stretch = low;
  }
  EXPECT_LT(truth.back(), recorded.back() - 0.005);
  expect_near(values_of(*strip("machine_compliance"), {0, compliance}), stress(force_at(truth)), 1e-8);
}

TEST_P(RecordedStrip, HasExactDerivatives) {
  const auto material = make_model("gho");
  for (const auto& [mechanism, amplitude] :
       {std::pair{"displacement_offset", -0.02}, {"zeroed_at_preload", 0.03}, {"machine_compliance", 3e-4}}) {
    const auto test = wrapped_test(
        mechanism, wrapped_test("force_scale_error", make_strip(recorded, {.channels = {"transverse_stretch", "stress"},
                                                                           .measure = GetParam().name})));
    const Simulation simulation{*test, *material, set_s, {1.5, 0.1, amplitude}, {}};
    for (const TestProperty& property : test_properties())
      EXPECT_EQ(property.check(simulation).counter_example, "") << mechanism << " " << property.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Measures, RecordedStrip,
                         ::testing::Values(Measure{"cauchy", 1}, Measure{"first_piola_kirchhoff", 0},
                                           Measure{"second_piola_kirchhoff", -1}),
                         [](const auto& at) { return std::string(at.param.name); });

TEST(RecordErrors, RefuseAStripWithoutStress) {
  try {
    static_cast<void>(wrapped_test("zeroed_at_preload", make_strip({1.1, 1.3}, {.channels = {"normal_stretch"}})));
    FAIL();
  } catch (const InputError& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("zeroed_at_preload: the test's data have no 'stress'"));
  }
}

const Values around{1.05, 1.1, 1.2, 1.3}, along{1.02, 1.05, 1.1, 1.15};

std::unique_ptr<Test> sheet(const Values& first, const Values& second) {
  return make_sheet("general", {{"stretch_circumferential", first}, {"stretch_axial", second}},
                    {.channels = {"stress_circumferential", "stress_axial"}});
}
Options channel(const std::string& name) {
  Options options;
  options.set("channel", name);
  return options;
}

/// Cauchy stress from force and recorded stretch: σ m/λ.
TEST(SheetPrestretch, IsThatOfOneDirection) {
  constexpr double amount = 0.05;
  Values truth = along;
  for (double& stretch : truth) stretch *= 1 + amount;
  Values expected = values_of(*sheet(around, truth), {});
  for (std::size_t i = 4; i < 8; ++i) expected[i] /= 1 + amount;
  const auto test = wrapped_test("sheet_prestretch", sheet(around, along), channel("stress_axial"));
  expect_near(values_of(*test, {amount}), expected, 1e-9);
}

TEST(SheetReadings, AreThoseOfOneLoadCellOrOfBoth) {
  const Values bare = values_of(*sheet(around, along), {});
  Values one = bare, both = bare;
  for (std::size_t i = 4; i < 8; ++i) one[i] += 3;
  for (double& value : both) value *= 1.2;
  expect_near(values_of(*wrapped_test("sheet_force_offset", sheet(around, along), channel("stress_axial")), {3}), one,
              1e-12);
  expect_near(values_of(*wrapped_test("sheet_force_scale_error", sheet(around, along)), {0.2}), both, 1e-12);
}

/// y − a dy/dt, here of a stretch that rises by 0.1 each second.
TEST(ChannelLag, TakesTheRateOfTheReadingOff) {
  const Values stretches{1.0, 1.1, 1.2, 1.3}, time{0, 1, 2, 3};
  constexpr double lag = 0.2;
  const Values bare = values_of(*make_strip(stretches, {.time = time}), {0});
  const auto test = wrapped_test("channel_lag", make_strip(stretches, {.time = time}));
  const Values expected{bare[0] - lag * (bare[1] - bare[0]), bare[1] - lag * (bare[2] - bare[0]) / 2,
                        bare[2] - lag * (bare[3] - bare[1]) / 2, bare[3] - lag * (bare[3] - bare[2])};
  expect_near(values_of(*test, {0, lag}), expected, 1e-12);
  const auto material = make_model("gho");
  const Simulation simulation{*test, *material, set_s, {0, lag}, {}};
  for (const TestProperty& property : test_properties())
    EXPECT_EQ(property.check(simulation).counter_example, "") << property.name;
}

TEST(ChannelLag, NeedsAClock) {
  EXPECT_THROW(static_cast<void>(wrapped_test("channel_lag", make_strip({1.1, 1.3}))), InputError);
}

}  // namespace
}  // namespace tunica::testing::record_errors_test
