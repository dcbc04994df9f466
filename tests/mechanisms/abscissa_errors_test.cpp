// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subject.hpp"

namespace tunica::testing::abscissa_errors_test {
namespace {

using Values = std::vector<double>;
using ::testing::HasSubstr;

Values values_of(const Test& test, const Values& own, const Model& material, const Values& parameters = set_s) {
  Values values(test.rows().channels.size() * test.rows().count);
  const Status status = test.predict({material, parameters, own}, {values, {}, {}, {}});
  EXPECT_TRUE(status.ok()) << status.reason();
  return values;
}
Values values_of(const Test& test, const Values& own) { return values_of(test, own, *make_model("gho")); }

void expect_near(const Values& a, const Values& b, double relative) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], relative * std::abs(b[i])) << i;
}

const Values pressures{1, 8, 15, 20};
Values corrected(const Values& measured, double scale, double shift) {
  Values truth;
  for (const double value : measured) truth.push_back(scale * value + shift);
  return truth;
}

TEST(PressureOffset, IsTheTubeUnderTheTruePressure) {
  const auto test = wrapped_test("pressure_offset", make_tube(pressures));
  expect_near(values_of(*test, {0, 0, 0, 0, 1, 0.7}), values_of(*make_tube(corrected(pressures, 1, 0.7)), bare_tube),
              1e-10);
}

TEST(PressureScaleError, IsTheTubeUnderTheTruePressure) {
  const auto test = wrapped_test("pressure_scale_error", make_tube(pressures));
  expect_near(values_of(*test, {0, 0, 0, 0, 1, -0.1}), values_of(*make_tube(corrected(pressures, 0.9, 0)), bare_tube),
              1e-10);
}

/// The outer one corrects the measured pressure, the inner one what it hands on.
TEST(AbscissaErrors, StandInOneAnother) {
  const auto material = make_model("gho");
  const auto test = wrapped_test("pressure_scale_error", wrapped_test("pressure_offset", make_tube(pressures)));
  const Values own{0, 0, 0, 0, 1, 0.7, -0.1};
  expect_near(values_of(*test, own), values_of(*make_tube(corrected(pressures, 0.9, 0.7)), bare_tube), 1e-10);
  const Simulation simulation{*test, *material, set_s, own, {}};
  for (const TestProperty& property : test_properties())
    EXPECT_EQ(property.check(simulation).counter_example, "") << property.name;
}

TEST(AbscissaErrors, LeaveTheOtherAbscissaAlone) {
  const Values axial{1.1, 1.15, 1.2, 1.25};
  const auto material = make_model("gho");
  const auto test = wrapped_test("pressure_offset", make_tube(pressures, {.axial_stretches = axial}));
  const auto truth = make_tube(corrected(pressures, 1, 0.7), {.axial_stretches = axial});
  expect_near(values_of(*test, {0, 0, 0, 0, 1, 0.7}), values_of(*truth, bare_tube), 1e-10);
  const Simulation simulation{*test, *material, set_s, {0, 0, 0, 0, 1, 0.7}, {}};
  EXPECT_EQ(abscissa_derivative_matches_differences(simulation).counter_example, "");
}

TEST(AbscissaErrors, ActOnWallsOfSeveralModels) {
  const auto inner = make_model("gho"), outer = make_model("neo_hooke");
  const std::vector<const Model*> layers{inner.get(), outer.get()};
  Values both = set_s;
  both.push_back(30);
  const auto test = wrapped_test("axial_force_scale_error",
                                 wrapped_test("pressure_offset", make_tube(pressures, {.layers = {1.2, 0.86}})));
  const Simulation simulation{*test, *inner, both, {0, 0, 0, 0, 0.7, 0.1}, layers};
  for (const TestProperty& property : test_properties())
    EXPECT_EQ(property.check(simulation).counter_example, "") << property.name;
}

/// A measure, data = P m^power; and whether the machine recorded the elongation, so that its distance from 1 is wrong.
struct Recorded {
  const char* measure;
  int power;
  bool elongation;
};

Values truth(const Recorded& how, const Values& measured, double error) {
  return corrected(measured, 1 + error, how.elongation ? -error : 0);
}
std::unique_ptr<Test> recorded(const Recorded& how, const Values& measured, StripSetup setup) {
  setup.measure = how.measure;
  setup.from_elongation = how.elongation;
  return make_strip(measured, setup);
}

class ReferenceLength : public ::testing::TestWithParam<Recorded> {};

/// The force is P(true) whatever the stretch it is divided or multiplied by: σ = P m, S = P/m with the measured m.
TEST_P(ReferenceLength, KeepsTheForceThatWasMeasured) {
  const int power = GetParam().power;
  constexpr double error = 0.04;
  const Values measured{1.02, 1.1, 1.3, 1.5};
  const std::vector<std::string> channels{"stress", "transverse_stretch"};
  const auto test = wrapped_test("reference_length_error", recorded(GetParam(), measured, {.channels = channels}));
  const auto nominal =
      make_strip(truth(GetParam(), measured, error), {.channels = channels, .measure = "first_piola_kirchhoff"});
  Values expected = values_of(*nominal, {0});
  for (std::size_t i = 0; i < measured.size(); ++i) expected[i] *= std::pow(measured[i], power);
  expect_near(values_of(*test, {0, error}), expected, 1e-9);
}

/// Models with memory give no exact derivatives, and the host differences what they predict.
TEST_P(ReferenceLength, ServesModelsWithMemory) {
  const int power = GetParam().power;
  constexpr double error = 0.04;
  const Values measured{1.02, 1.3, 1.5, 1.1}, time{1, 2, 3, 4}, parameters{18.7, 24.9, 0.9, 46, 0.5, 0.4, 0.7, 3};
  const auto material = wrapped("viscoelasticity", wrapped("stress_softening", model("hgo")));
  const auto test = wrapped_test("reference_length_error", recorded(GetParam(), measured, {.time = time}));
  const auto nominal =
      make_strip(truth(GetParam(), measured, error), {.measure = "first_piola_kirchhoff", .time = time});
  Values expected = values_of(*nominal, {0}, *material, parameters);
  for (std::size_t i = 0; i < measured.size(); ++i) expected[i] *= std::pow(measured[i], power);
  expect_near(values_of(*test, {0, error}, *material, parameters), expected, 1e-9);
  // Rows depend on the abscissae before them: the column of the error is a difference, that of s is carried along.
  Values jacobian(4 * 10);
  ASSERT_TRUE(test->predict({*material, parameters, Values{0, error}}, {{}, jacobian, {}, {}}).ok());
  constexpr double h = 1e-5;
  constexpr std::size_t s = 4, of_error = 9;
  const auto moved = [&](double by_s, double by_error) {
    Values p = parameters;
    p[s] += by_s;
    return values_of(*test, {0, error + by_error}, *material, p);
  };
  const Values soft = moved(h, 0), hard = moved(-h, 0), longer = moved(0, h), shorter = moved(0, -h);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(jacobian[4 * s + i], (soft[i] - hard[i]) / (2 * h), 1e-6 * expected[2]) << i;
    EXPECT_NEAR(jacobian[4 * of_error + i], (longer[i] - shorter[i]) / (2 * h), 1e-5 * expected[2] / error) << i;
  }
}

TEST_P(ReferenceLength, HasExactDerivativesBesideErrorsOfTheForce) {
  const auto material = make_model("gho");
  auto bare = recorded(GetParam(), {1.02, 1.1, 1.3, 1.5}, {.channels = {"transverse_stretch", "stress"}});
  const auto test = wrapped_test("reference_length_error", wrapped_test("force_offset", std::move(bare)));
  const Simulation simulation{*test, *material, set_s, {2, 1.5, -0.03}, {}};
  for (const TestProperty& property : test_properties())
    EXPECT_EQ(property.check(simulation).counter_example, "") << property.name;
}

INSTANTIATE_TEST_SUITE_P(Measures, ReferenceLength,
                         ::testing::Values(Recorded{"cauchy", 1, false}, Recorded{"first_piola_kirchhoff", 0, false},
                                           Recorded{"second_piola_kirchhoff", -1, false}, Recorded{"cauchy", 1, true},
                                           Recorded{"first_piola_kirchhoff", 0, true},
                                           Recorded{"second_piola_kirchhoff", -1, true}),
                         [](const auto& at) {
                           return std::string(at.param.measure) + (at.param.elongation ? "_elongation" : "");
                         });

TEST(ReferenceLengthError, NeedsNoStress) {
  const auto test = wrapped_test("reference_length_error", make_strip({1.1, 1.3}, {.channels = {"normal_stretch"}}));
  expect_near(values_of(*test, {0, 0.02}),
              values_of(*make_strip({1.1 * 1.02, 1.3 * 1.02}, {.channels = {"normal_stretch"}}), {0}), 1e-10);
}

std::string refusal(const std::string& mechanism, std::unique_ptr<Test> base) {
  try {
    static_cast<void>(wrapped_test(mechanism, std::move(base)));
  } catch (const InputError& problem) {
    return problem.what();
  }
  return "";
}

TEST(AbscissaErrors, RefuseTestsWithoutTheAbscissa) {
  EXPECT_THAT(
      refusal("pressure_offset", make_strip({1.1, 1.3})),
      HasSubstr("pressure_offset: the test's data have no 'pressure', which is what the mechanism corrects; map "
                "a column to 'pressure', or take the mechanism out"));
  EXPECT_THAT(refusal("reference_length_error", make_tube(pressures)),
              HasSubstr("reference_length_error: the test's data have no 'stretch'"));
}

/// Says of every stretch that the stress is 7.
class Stubborn final : public Test {
 public:
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }
  Status predict(const TestInput&, const TestOutput& output) const override {
    for (double& value : output.values) value = 7;
    return {};
  }

 private:
  Values stretch_{1.1};
  TestRows rows_{1, {{"stretch", stretch_}}, {"stress"}, {}};
  TestDescription description_;
};

TEST(ReferenceLengthError, RefusesAStressThatIsNoStripS) {
  EXPECT_THAT(refusal("reference_length_error", std::make_unique<Stubborn>()),
              HasSubstr("the test's stress is no Cauchy, first or second Piola-Kirchhoff stress of a strip with free "
                        "lateral faces"));
}

}  // namespace
}  // namespace tunica::testing::abscissa_errors_test
