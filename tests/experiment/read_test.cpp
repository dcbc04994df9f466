// SPDX-License-Identifier: Apache-2.0
#include "experiment/reading.hpp"

namespace tunica::experiment {
namespace {

struct ReadExperiment : testing::Reading {};

TEST_F(ReadExperiment, ReadsTheExampleOfTheDesign) {
  const Experiment e = read(testing::design_example);
  EXPECT_EQ(e.name, "lamb-aorta");
  EXPECT_EQ(e.seed, 7u);
  const ModelEntry& gho = e.model("gho");
  EXPECT_EQ(gho.options.text("fibre_switch"), "strain");
  EXPECT_EQ(gho.parameters.at("mu").min, 0.5);
  EXPECT_EQ(gho.parameters.at("mu").max, 200);
  EXPECT_EQ(gho.parameters.at("mu").scale, Scale::log);
  EXPECT_EQ(gho.parameters.at("mu").initial, 10);
  EXPECT_EQ(gho.parameters.at("kappa").max, 0.3333);
  EXPECT_EQ(gho.parameters.at("theta").max, 90);
  ASSERT_EQ(gho.mechanisms.size(), 1u);
  EXPECT_EQ(gho.mechanisms[0].type, "viscoelasticity");
  EXPECT_EQ(gho.mechanisms[0].parameters.at("tau").initial, 10);
  const TestEntry& strip = e.test("circumferential_strip");
  EXPECT_EQ(strip.options.text("direction"), "circumferential");
  EXPECT_EQ(strip.data.files, std::vector{folder.path() / "circ.csv"});
  EXPECT_EQ(strip.data.rows.first, 0u);
  EXPECT_EQ(strip.data.rows.last, 240u);
  EXPECT_EQ(strip.data.rows.step, 6u);
  ASSERT_EQ(strip.data.noise.size(), 1u);
  EXPECT_EQ(strip.data.noise[0].first, "stress");
  EXPECT_EQ(strip.data.noise[0].second.relative, 0.02);
  const TestEntry& tube = e.test("inflation");
  EXPECT_EQ(tube.options.number("inner_radius"), 3.71);
  EXPECT_EQ(tube.options.text("layers"), "[]");
  EXPECT_EQ(tube.weights, (std::vector<double>{1, 1}));
  EXPECT_EQ(e.optimizer("es").options.integer("parents"), 30);
  EXPECT_TRUE(e.optimizer("lm").options.flag("polish"));
  ASSERT_EQ(e.optimizer("hybrid").stages.size(), 2u);
  ASSERT_EQ(e.runs.size(), 2u);
  EXPECT_EQ(e.runs[0].realisations, 100u);
  EXPECT_EQ(e.runs[1].tests, (std::vector<std::string>{"circumferential_strip", "inflation"}));
  EXPECT_EQ(e.runs[1].stop.max_time, 600);
  EXPECT_EQ(e.runs[1].stop.stall, 500u);
  ASSERT_EQ(e.runs[1].constraints.size(), 1u);
  EXPECT_EQ(e.runs[1].constraints[0].json, R"({"type":"transverse_stability","h":0.7})");
  EXPECT_EQ(e.diagnosis_json, R"({"model":"gho","optimizer":"lm","alpha":0.05,"mechanisms":"all"})");
}

TEST_F(ReadExperiment, WritesAnInputFileThatReadsAsTheSameExperiment) {
  const Experiment first = read(testing::design_example);
  const Experiment again = read(first.input_json);
  EXPECT_EQ(again.input_json, first.input_json);
  EXPECT_EQ(again.diagnosis_json, first.diagnosis_json);
}

}  // namespace
}  // namespace tunica::experiment
