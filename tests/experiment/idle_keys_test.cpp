// SPDX-License-Identifier: Apache-2.0
#include "experiment/reading.hpp"

/// Keys that another key leaves without effect are refused: they look as if they were used.
namespace tunica::experiment {
namespace {

using testing::expect_within;

class IdleKeys : public testing::Reading {
 protected:
  /// The message about a strip with these columns, whose data block ends with these keys.
  [[nodiscard]] std::string strip(std::string_view columns, std::string_view keys) const {
    std::string text = with(R"({"stretch": "stretch", "stress": "stress"})", columns);
    return refusal(with(R"("rows": "0:240:6")", keys, std::move(text)));
  }
  static constexpr std::string_view own = R"({"stretch": "stretch", "stress": "stress"})";
  static constexpr std::string_view force_and_way = R"({"displacement": "Way", "force": "Force"})";
};

TEST_F(IdleKeys, GripDistanceBesideAGaugeLengthIsRefusedWithBothWays) {
  const std::string message =
      strip(force_and_way, R"("specimen": {"area": 26.584, "gauge_length": 22.76, "grip_distance": "20.68 mm"})");
  expect_within(message, "\"grip_distance\" changes nothing beside a \"gauge_length\" of 22.76 mm");
  expect_within(message, "as \"length\"");
  expect_within(message, "\"gauge_length\": \"preload\"");
}

TEST_F(IdleKeys, SizesThatNoColumnNeedsAreRefused) {
  expect_within(strip(own, R"("specimen": {"width": 4})"), "\"width\" changes nothing");
  expect_within(strip(own, R"("specimen": {"gauge_length": 10})"), "It belongs to a displacement or a length");
  EXPECT_EQ(strip(force_and_way, R"("specimen": {"width": 4, "thickness": 1, "gauge_length": 10})"), "");
}

TEST_F(IdleKeys, AMeasureOrAnOrderThatChangesNothingIsRefused) {
  expect_within(refusal(R"("file": "inflation.csv",)", R"("file": "inflation.csv", "stress_measure": "cauchy",)"),
                "no stress is mapped");
  expect_within(strip(own, R"("order": "unknown", "cycle": "last")"), "\"cycle\" gives the order of the rows");
  expect_within(refusal(R"("on_failure": "penalise")", R"("on_failure": {"policy": "stop", "max_rate": "50 %"})"),
                "\"max_rate\" changes nothing");
}

TEST_F(IdleKeys, ANoiseOfNothingMeasuredIsRefused) {
  expect_within(strip(R"({"stretch": "stretch"})", R"("rows": "0:240:6")"), "no measured quantity is mapped");
}

TEST_F(IdleKeys, LimitsThatAnotherOneForestallsAreRefused) {
  const auto stop = [&](std::string_view keys) {
    return refusal(R"("max_evaluations": 60000, "max_time": "10 min", "target": 1e-6, "stall": 500)", keys);
  };
  expect_within(stop(R"("max_evaluations": 100, "stall": 200)"), "\"stall\" is 200 and changes nothing");
  expect_within(stop(R"("stall": 70000)"), "the search ends after 60000 evaluations");
  EXPECT_EQ(stop(R"("max_evaluations": 100, "stall": 100)"), "");
}

TEST_F(IdleKeys, PointsOfNoMapAndWeightsOfWhatIsHeldOutAreRefused) {
  expect_within(
      refusal(R"("on_failure": "penalise")", R"("on_failure": "penalise", "analysis": {"stability": {"points": 21}})"),
      "\"points\" changes nothing without \"map\"");
  const auto held_out = [&](std::string_view weight) {
    return refusal(with(R"("weight": 1)", weight, with(R"("hold_out": false)", R"("hold_out": true)")));
  };
  expect_within(held_out(R"("weight": 2)"),
                "\"weight\" changes nothing in test 'circumferential_strip', which is held");
  EXPECT_EQ(held_out(R"("weight": 1)"), "");
}

TEST_F(IdleKeys, AnAngleThatLooksLikeRadiansIsAskedAbout) {
  const auto findings = [&](std::string_view setting) {
    return read(with(R"("kappa": {"min": 0, "max": 0.3333})", setting)).models[0].findings;
  };
  const auto bare = findings(R"("theta": {"fixed": 0.8})");
  ASSERT_EQ(bare.size(), 1u);
  EXPECT_EQ(bare[0].kind, data::FindingKind::record_angle);
  expect_within(bare[0].text, "'theta' of model 'gho' is 0.8 without a unit");
  EXPECT_TRUE(findings(R"("theta": {"fixed": "0.8 rad"})").empty());
  EXPECT_TRUE(findings(R"("theta": {"min": 0, "max": 90})").empty());
}

TEST_F(IdleKeys, AnAngleOfATestThatLooksLikeRadiansIsAskedAbout) {
  const auto findings = [&](std::string_view value) {
    return read(with(R"("weight": 1,)", std::string(R"("parameters": {"misalignment": {"fixed": )") +
                                            std::string(value) + R"(}}, "weight": 1,)"))
        .tests[0]
        .findings;
  };
  const auto bare = findings("0.8");
  ASSERT_EQ(bare.size(), 1u);
  expect_within(bare[0].text, "'misalignment' of test 'circumferential_strip' is 0.8 without a unit");
  EXPECT_TRUE(findings("\"0.8 deg\"").empty());
  EXPECT_TRUE(findings("8").empty());
}

TEST_F(IdleKeys, RunsAreNotNeededForAPrediction) {
  std::string text = testing::design_example;
  const std::size_t from = text.find("\"optimizers\""), to = text.find("\"on_failure\"");
  text.erase(from, to - from);
  text = with(R"(,
  "diagnosis": {"model": "gho", "optimizer": "lm", "alpha": 0.05, "mechanisms": "all"})",
              "", std::move(text));
  expect_within(refusal(text), "optimizers");
  const auto file = folder.write("experiment.json", text);
  const Experiment predicted = read_experiment(file, testing::fake_catalogue(), Purpose::prediction);
  EXPECT_TRUE(predicted.only_predicts);
  ASSERT_EQ(predicted.runs.size(), 1u);
  EXPECT_EQ(predicted.runs[0].model, "gho");
  EXPECT_EQ(predicted.runs[0].tests.size(), 2u);
}

}  // namespace
}  // namespace tunica::experiment
