// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "controlled.hpp"
#include "support/strip.hpp"

// Loading that is stated: closed forms, the same loading row by row, derivatives, and what is refused.
namespace tunica::testing::loading_segments_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::vector<double> gho{18.668, 0.1367, 24.905, 0.2912, 46.44, 0.8, 5, 0.3, 60};

TEST(LoadingSegments, RelaxAsTheClosedFormOfAPronySeriesDoes) {
  // A jump to λ: P(t) = μ (λ − λ⁻²) (1 + Σ g_i e^{−t/τ_i}). The row at the jump is behind it.
  constexpr double stretch = 1.4, mu = 12;
  const std::vector<double> time{0, 0.5, 2, 10, 200};
  const auto test = make_segments(R"([{"ramp": {"stretch": 1.4}, "duration": 0}, {"hold": 200}])", time, {"stress"});
  const Predicted found = predicted(*test, *viscous("neo_hooke", 2), {mu, 0.8, 5, 0.3, 60});
  ASSERT_TRUE(found.status.ok()) << found.status.reason();
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double series = 1 + 0.8 * std::exp(-time[i] / 5) + 0.3 * std::exp(-time[i] / 60);
    const double expected = mu * (stretch - 1 / (stretch * stretch)) * series;
    EXPECT_NEAR(found.values[i] / expected, 1, 1e-12) << time[i] << " s";
  }
}

TEST(LoadingSegments, AreTheSameLoadingRowByRow) {
  // Ramp, hold, ramp back: steps of the segments are the rows of the strip.
  const std::vector<double> time{0.5, 1, 2, 5, 9, 9.5, 10};
  const std::vector<double> stretch{1.1, 1.2, 1.2, 1.2, 1.2, 1.15, 1.1};
  const std::string json =
      R"([{"ramp": {"stretch": 1.2}, "rate": 0.2}, {"hold": 8}, {"ramp": {"displacement": 2}, "duration": 1}])";
  const auto model = viscous("gho", 2);
  const Predicted stated =
      predicted(*make_segments(json, time, {"stress", "stretch", "transverse_stretch"}, 1), *model, gho);
  ASSERT_TRUE(stated.status.ok()) << stated.status.reason();
  const auto strip = make_strip(
      stretch, {.channels = {"stress", "transverse_stretch"}, .measure = "first_piola_kirchhoff", .time = time});
  const Prediction rows = predict(*strip, *model, gho);
  for (std::size_t i = 0; i < time.size(); ++i) {
    EXPECT_NEAR(stated.values[i], rows.values[i], 1e-9) << i;
    EXPECT_NEAR(stated.values[7 + i], stretch[i], 1e-12) << i;
    EXPECT_NEAR(stated.values[14 + i], rows.values[7 + i], 1e-9) << i;
  }
}

TEST(LoadingSegments, ChangeFromStretchToStressAndBackWhereTheStripIs) {
  // After a hold of the stretch, its stress is held: the stretch goes on from where it was, and creeps upwards.
  const std::string json = R"([{"ramp": {"stretch": 1.3}, "duration": 1}, {"hold": 10},
      {"ramp": {"nominal_stress": 0}, "duration": 2}, {"hold": 500}, {"ramp": {"force": 60}, "duration": 1}])";
  const std::vector<double> time{1, 11, 12, 13, 14, 500, 514};
  const auto model = viscous("neo_hooke", 1);
  const Predicted found = predicted(*make_segments(json, time, {"stress", "stretch"}), *model, {12, 0.8, 20});
  ASSERT_TRUE(found.status.ok()) << found.status.reason();
  const double *const stress = found.values.data(), *const stretch = stress + time.size();
  EXPECT_NEAR(stretch[1], 1.3, 1e-12);
  EXPECT_NEAR(stress[2], stress[1] / 2, 1e-9) << "half of the way down";
  EXPECT_NEAR(stress[3], 0, 1e-9);
  EXPECT_GT(stretch[3], 1.01) << "not recovered yet";
  EXPECT_LT(stretch[4], stretch[3]);
  EXPECT_NEAR(stretch[5], 1, 1e-5) << "recovered";
  EXPECT_NEAR(stress[6], 6, 1e-9) << "60 mN on 10 mm2";
}

TEST(LoadingSegments, GoToAndFroInCycles) {
  const std::string json = R"([{"cycle": {"stretch": [1.1, 1.3]}, "duration": 4, "count": 3}])";
  const Predicted found =
      predicted(*make_segments(json, {1, 2, 3, 4, 6, 8, 12}, {"stretch"}), *make_model("neo_hooke"), {12});
  ASSERT_TRUE(found.status.ok());
  const std::vector<double> expected{1.15, 1.3, 1.2, 1.1, 1.3, 1.1, 1.1};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found.values[i], expected[i], 1e-12);
}

TEST(LoadingSegments, ConvergeWithTheSquareOfTheStep) {
  const std::string json = R"([{"ramp": {"nominal_stress": 8}, "duration": 1}, {"hold": 50}])";
  const auto model = viscous("gho", 2);
  const auto at = [&](std::int64_t steps) {
    return predicted(*make_segments(json, {51}, {"stretch"}, steps), *model, gho).values[0];
  };
  const double finest = at(1280), coarse = std::abs(at(40) - finest), fine = std::abs(at(160) - finest);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_GT(coarse / fine, 10) << "16 times as near with a quarter of the step";
}

TEST(LoadingSegments, CarryDerivativesByAllParametersAsDifferencesFindThem) {
  const std::string json = R"([{"ramp": {"stretch": 1.3}, "duration": 1}, {"hold": 10},
      {"ramp": {"cauchy_stress": 3}, "duration": 2}, {"hold": 100}, {"cycle": {"stretch": [1.1, 1.35]}, "duration": 3}])";
  const auto test = make_segments(json, {0.5, 1, 5, 12, 13, 40, 113, 114.5, 116}, {"stress", "stretch"}, 6);
  const auto model = viscous("gho", 2);
  const Predicted exact = predicted(*test, *model, gho, true);
  ASSERT_TRUE(exact.status.ok()) << exact.status.reason();
  const std::size_t size = exact.values.size();
  for (std::size_t j = 0; j < gho.size(); ++j) {
    std::vector<double> p = gho;
    const double h = 1e-4 * p[j];
    const auto moved = [&](double by) {
      p[j] = gho[j] + by;
      return predicted(*test, *model, p).values;
    };
    const auto a = moved(h), b = moved(-h), c = moved(2 * h), d = moved(-2 * h);
    for (std::size_t i = 0; i < size; ++i) {
      const double difference = (8 * (a[i] - b[i]) - (c[i] - d[i])) / (12 * h);
      EXPECT_NEAR(exact.jacobian[j * size + i], difference, 1e-7 / p[j] + 1e-7 * std::abs(difference))
          << "parameter " << j << ", value " << i;
    }
  }
}

std::string refusal(const std::string& json, const std::vector<double>& time = {0.5}) {
  try {
    make_segments(json, time, {"stress"});
  } catch (const InputError& problem) {
    return problem.what();
  }
  return "accepted";
}

TEST(LoadingSegments, SayWhichSegmentIsWrongAndWhatToDo) {
  EXPECT_THAT(refusal("{"), HasSubstr("is no JSON; give a list"));
  EXPECT_THAT(refusal("[]"), HasSubstr("is empty; give a list such as"));
  EXPECT_THAT(refusal("{}"), HasSubstr("is no list; give a list such as"));
  EXPECT_THAT(refusal(R"([{"hold": 1}])"), AllOf(HasSubstr("segment 1"), HasSubstr("expected a ramp first")));
  EXPECT_THAT(refusal(R"([{"ramp": {"stretch": 2}, "duration": 1}, 3])"), HasSubstr("segment 2 of \"segments\" is 3"));
  EXPECT_THAT(refusal(R"([{"ramp": {"stretch": 2}, "speed": 1}])"), HasSubstr("has the key 'speed'"));
  EXPECT_THAT(refusal(R"([{"ramp": {"strain": 2}, "rate": 1}])"), HasSubstr("prescribes 'strain'; expected one of"));
  EXPECT_THAT(refusal(R"([{"ramp": 2, "rate": 1}])"), HasSubstr("prescribes 2; give one quantity"));
  EXPECT_THAT(refusal(R"([{"ramp": {"stretch": 2}}])"), HasSubstr("has neither \"duration\" nor \"rate\""));
  EXPECT_THAT(refusal(R"([{"ramp": {"stretch": 2}, "rate": 1, "duration": 1}])"), HasSubstr("give one of them"));
  EXPECT_THAT(refusal(R"([{"ramp": {"stretch": 2}, "rate": 0}])"), HasSubstr("expected one above 0"));
  EXPECT_THAT(refusal(R"([{"ramp": {"stretch": 2}, "duration": -1}])"), HasSubstr("expected 0 s or more"));
  EXPECT_THAT(refusal(R"([{"ramp": {"stretch": 0}, "duration": 1}])"), HasSubstr("expected one above 0"));
  EXPECT_THAT(refusal(R"([{"ramp": {"stretch": true}, "duration": 1}])"), HasSubstr("expected a number"));
  EXPECT_THAT(refusal(R"([{"ramp": {"stretch": "2 x"}, "duration": 1}])"), HasSubstr("with a unit; give it in 1"));
  EXPECT_THAT(refusal(R"([{"cycle": {"stretch": 2}, "duration": 1}])"), HasSubstr("give the two values"));
  EXPECT_THAT(refusal(R"([{"cycle": {"stretch": [1, 2]}, "duration": 1, "count": 0}])"), HasSubstr("has the count 0"));
  EXPECT_THAT(refusal(R"([{"ramp": {"stretch": 2}, "duration": 1}, {"ramp": {"force": 2}, "rate": 1}])"),
              HasSubstr("give its \"duration\""));
  EXPECT_THAT(refusal(R"([{"ramp": {"stretch": 2}, "duration": 1}])", {0.5, 3}),
              AllOf(HasSubstr("row 2 is at 3.000000 s"), HasSubstr("lengthen the segments")));
}

TEST(LoadingSegments, RefuseMoreStepsThanASimulationCanHave) {
  EXPECT_THAT(
      [] {
        make_segments(R"([{"cycle": {"stretch": [1, 2]}, "duration": 1, "count": 10000}])", {0.5}, {"stress"}, 10000);
      },
      ::testing::ThrowsMessage<InputError>(HasSubstr("would take 200000000.000000 steps")));
}

TEST(LoadingSegments, NeedSizesForDisplacementsAndForces) {
  TestSetup setup;
  setup.options.set("direction", std::string("axial"));
  setup.options.set("steps", std::int64_t{5});
  setup.options.set("gauge_length", 0.0);
  setup.options.set("area", 0.0);
  setup.options.set("permanent_set", false);
  set_temperature(setup, "none", 0, 0);
  setup.rows = {1, {}, {"stress"}, {}};
  const std::vector<double> time{0.5};
  setup.rows.time = time;
  const auto refused = [&](const char* json) -> std::string {
    setup.options.set("segments", std::string(json));
    try {
      plugins::create(catalogue().tests().at("loading_segments"), setup);
    } catch (const InputError& problem) {
      return problem.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refused(R"([{"ramp": {"displacement": 2}, "duration": 1}])"), HasSubstr("has no \"gauge_length\""));
  EXPECT_THAT(refused(R"([{"ramp": {"force": 2}, "duration": 1}])"), HasSubstr("has no \"area\""));
  setup.rows.time = {};
  EXPECT_THAT(refused(R"([{"ramp": {"stretch": 2}, "duration": 1}])"), HasSubstr("no column mapped to 'time'"));
}

}  // namespace
}  // namespace tunica::testing::loading_segments_test
