// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <iterator>

#include "experiment/materials.hpp"
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
  EXPECT_EQ(tube.options.text("remarks"), "[]");
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
  ASSERT_TRUE(e.diagnosis);
  EXPECT_EQ(e.diagnosis->model, "gho");
  EXPECT_EQ(e.diagnosis->optimizer, "lm");
  EXPECT_EQ(e.diagnosis->alpha, 0.05);
  EXPECT_TRUE(e.diagnosis->all_mechanisms);
  EXPECT_TRUE(e.diagnosis->mechanisms.empty());
  EXPECT_FALSE(e.diagnosis->admissibility);
}

TEST_F(ReadExperiment, WritesAnInputFileThatReadsAsTheSameExperiment) {
  const Experiment first = read(testing::design_example);
  const Experiment again = read(first.input_json);
  EXPECT_EQ(again.input_json, first.input_json);
  ASSERT_TRUE(again.diagnosis);
  EXPECT_EQ(again.diagnosis->alpha, first.diagnosis->alpha);
}

TEST_F(ReadExperiment, KnowsWhatAModelStandsFor) {
  const std::string text = with(R"("type": "gho",)", R"("type": "gho", "material": "artery",)");
  const Experiment first = read(text);
  EXPECT_EQ(first.model("gho").options.text(material_key), "artery");
  EXPECT_EQ(read(first.input_json).model("gho").options.text(material_key), "artery");
  testing::expect_within(refusal(with("artery", "artary", text)), "Did you mean 'artery'?");
}

TEST_F(ReadExperiment, KnowsPublishedStiffnessesWithTheirSources) {
  ASSERT_FALSE(known_materials().empty());
  for (const std::string& name : known_materials()) {
    const auto published = stiffness_of(name);
    ASSERT_TRUE(published) << name;
    EXPECT_GT(published->stiffness, 0) << name;
    EXPECT_GE(published->factor, 30) << name << ": nine of ten honest tissues lie outside narrow ranges";
    EXPECT_FALSE(published->source.empty()) << name;
  }
  EXPECT_FALSE(stiffness_of("jelly"));
}

TEST_F(ReadExperiment, ReadsTheExampleOfTheManual) {
  std::ifstream stream(std::filesystem::path(TUNICA_SOURCE_DIR) / "docs" / "experiment-file.md");
  const std::string manual((std::istreambuf_iterator<char>(stream)), {});
  const std::size_t begin = manual.find("```json\n") + 8;
  ASSERT_GE(begin, 8u);
  const Experiment e = read(manual.substr(begin, manual.find("```", begin) - begin));
  EXPECT_EQ(e.model("dispersed").mechanisms[0].parameters.at("tau").max, 600);
  const TestEntry& strip = e.test("strip");
  EXPECT_EQ(strip.data.time_rate, 0.01);
  EXPECT_EQ(strip.data.noise[0].second.absolute, 0.1);
  EXPECT_EQ(strip.data.noise[0].second.relative, 0.02);
  EXPECT_EQ(strip.mechanisms[0].type, "force_offset");
  EXPECT_EQ(e.optimizer("both").stages[1].stop->max_evaluations, 500u);
  EXPECT_FALSE(e.optimizer("both").stages[0].stop);
  EXPECT_EQ(e.runs[0].objective, ObjectiveType::sum_of_norms);
  EXPECT_EQ(e.runs[1].stop.max_evaluations, 2000u);
  EXPECT_FALSE(e.runs[1].stop.stall) << "a run's stop replaces the whole block";
}

TEST_F(ReadExperiment, LetsRunsOverrideWholeBlocks) {
  const Experiment e = read(with(
      R"({"model": "gho", "optimizer": "lm"}
  ])",
      R"({"model": "gho", "optimizer": "lm", "tests": ["inflation"], "objective": "least_squares", "constraints": []},
    {"model": "gho", "optimizer": "lm", "tests": {"short_strip": {"type": "uniaxial", "direction": "axial",
      "data": {"file": "circ2.csv", "columns": {"stretch": "stretch", "stress": "stress"}}}}}
  ])"));
  ASSERT_EQ(e.runs.size(), 3u);
  EXPECT_EQ(e.runs[0].tests.size(), 2u) << "a run's own tests do not join the others";
  EXPECT_EQ(e.runs[1].tests, std::vector<std::string>{"inflation"});
  EXPECT_EQ(e.runs[1].objective, ObjectiveType::least_squares);
  EXPECT_TRUE(e.runs[1].constraints.empty());
  EXPECT_EQ(e.runs[0].constraints.size(), 1u);
  EXPECT_EQ(e.runs[2].tests, std::vector<std::string>{"short_strip"});
  EXPECT_EQ(e.test("short_strip").options.text("direction"), "axial");
  EXPECT_EQ(read(e.input_json).input_json, e.input_json);
}

TEST_F(ReadExperiment, ReadsRichTestsThatWriteBackTheSame) {
  const Experiment e = read(with(
      R"("weight": 1,)",
      R"("weight": [0.5], "parameters": {"misalignment": {"max": "5 deg"}}, "mechanisms": [{"type": "outliers", "rows": "3"}],)",
      with(
          R"("file": "circ.csv",)",
          R"("files": ["circ.csv", "circ2.csv"], "where": {"specimen": 7, "side": "left"}, "order": "loading", "time_from": {"rate": "1 %/min"},)",
          with(R"("hold_out": false)", R"("hold_out": "10:20:2")",
               with(R"("axial_stretch": 1.2,)", R"("remarks": [{"at": "80 mmHg", "seen": "a leak"}],)")))));
  const TestEntry& strip = e.test("circumferential_strip");
  EXPECT_EQ(strip.data.files.size(), 2u);
  EXPECT_EQ(strip.data.where[0], (std::pair<std::string, std::string>{"specimen", "7"}));
  EXPECT_EQ(strip.data.order, data::Order::loading);
  EXPECT_EQ(e.test("inflation").data.order, data::Order::unknown);
  EXPECT_NEAR(*strip.data.time_rate, 0.01 / 60, 1e-18);
  EXPECT_EQ(strip.hold_out.rows->first, 10u);
  EXPECT_EQ(strip.hold_out.rows->step, 2u);
  EXPECT_EQ(strip.weights, std::vector<double>{0.5});
  EXPECT_EQ(e.test("inflation").options.text("remarks"), R"([{"at":"80 mmHg","seen":"a leak"}])");
  EXPECT_EQ(e.test("inflation").options.number("axial_stretch"), 1.0);
  EXPECT_EQ(read(e.input_json).input_json, e.input_json);
}

TEST_F(ReadExperiment, FillsDefaultsIn) {
  const Experiment e =
      read(R"({"format": 1, "models": {"m": {"type": "plain"}}, "optimizers": {"lm": {"type": "ceres_lm"}},
    "tests": {"t": {"type": "uniaxial", "direction": "axial", "data": {"file": "circ.csv", "columns": {"stretch": "stretch", "stress": "stress"}}}},
    "runs": [{"model": "m", "optimizer": "lm"}]})");
  EXPECT_EQ(e.name, "experiment");
  EXPECT_EQ(e.seed, 1u);
  EXPECT_EQ(e.runs[0].realisations, 1u);
  EXPECT_EQ(e.runs[0].stop.max_evaluations, 60000u);
  EXPECT_FALSE(e.runs[0].stop.max_time || e.runs[0].stop.target || e.runs[0].stop.stall);
  EXPECT_EQ(e.runs[0].objective, ObjectiveType::standardised_quadratic);
  EXPECT_EQ(e.on_failure, OnFailure::penalise);
  EXPECT_EQ(e.max_failure_rate, 1);
  EXPECT_EQ(e.test("t").data.stress_measure, "cauchy");
  EXPECT_EQ(e.test("t").weights, std::vector<double>{1});
  EXPECT_TRUE(e.test("t").data.noise.empty());
  EXPECT_FALSE(e.diagnosis);
}

TEST_F(ReadExperiment, ResolvesPathsFromItsOwnFolder) {
  std::filesystem::create_directory(folder.path() / "sub");
  static_cast<void>(folder.write(
      "sub/e.json", with(R"("circ.csv")", R"("../circ.csv")", with(R"("inflation.csv")", R"("../inflation.csv")"))));
  EXPECT_EQ(
      read_experiment(folder.path() / "sub" / "e.json", testing::fake_catalogue()).test("inflation").data.files[0],
      folder.path() / "inflation.csv");
}

}  // namespace
}  // namespace tunica::experiment
