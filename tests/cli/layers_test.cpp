// SPDX-License-Identifier: Apache-2.0
// A tube of two layers with models of their own, from the experiment file to the report.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::AllOf;
using ::testing::HasSubstr;

namespace {

const std::map<std::string, double> truth{{"media.mu", 12}, {"media.k1", 15}, {"media.k2", 0.8}, {"adventitia.mu", 45}};

/// Media and adventitia in a tube inflated at three axial stretches; what it measures is what `simulate` makes of the
/// truth.
class Layers : public ::testing::Test {
 protected:
  Layers() {
    std::string rows = "pressure [mmHg],axial_stretch [1],outer [mm],force [mN]\n";
    for (const double stretch : {1.1, 1.3, 1.5})
      for (int k = 0; k <= 6; ++k) rows += fmt::format("{},{},1,1\n", 25 * k, stretch);
    bench.folder.write("tube.csv", rows);
    bench.experiment["models"] = {{"media", {{"type", "hgo"}, {"parameters", {{"theta", {{"fixed", 40}}}}}}},
                                  {"adventitia", {{"type", "neo_hooke"}}},
                                  {"gho", {{"type", "gho"}}}};
    bench.experiment["tests"] = {
        {"tube",
         {{"type", "thick_wall_pressurisation"},
          {"inner_radius", "3.71 mm"},
          {"layers",
           {{{"model", "media"}, {"thickness", "1.3 mm"}}, {{"model", "adventitia"}, {"thickness", "760 um"}}}},
          {"data",
           {{"file", "tube.csv"},
            {"columns",
             {{"pressure", "pressure"},
              {"axial_stretch", "axial_stretch"},
              {"outer_diameter", "outer"},
              {"axial_force", "force"}}}}}}}};
    bench.experiment["objective"] = {{"type", "standardised_quadratic"}};
    bench.experiment["runs"] = {{{"optimizer", "lm"}}};
  }
  /// Data from the truth, and the experiment on them.
  void measure() {
    bench.folder.write("truth.json", nlohmann::json(truth).dump());
    const auto ended = bench.tunica({"simulate", "experiment.json", "--parameters", "truth.json", "-o", "synthetic"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    bench.experiment["tests"]["tube"]["data"]["file"] = "synthetic/tube.csv";
  }
  [[nodiscard]] std::string refused(std::vector<std::string> arguments) const {
    const auto ended = bench.tunica(std::move(arguments));
    EXPECT_EQ(ended.code, 2) << ended.out;
    return ended.err;
  }

  trial::Bench bench;
};

TEST_F(Layers, AreRecoveredFromOneTube) {
  measure();
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto run = bench.result("out")["runs"][0];
  EXPECT_EQ(run["run"], "media+adventitia/lm");
  EXPECT_EQ(run["model"], "media+adventitia");
  const auto& parameters = run["best"]["parameters"];
  EXPECT_EQ(parameters.size(), truth.size());
  for (const auto& [name, value] : truth)
    EXPECT_NEAR(parameters[name]["value"].get<double>(), value, 1e-4 * value) << name;
  EXPECT_EQ(run["fixed"]["media.theta"]["value"], 40);
  EXPECT_EQ(run["best"]["certificate"]["verdict_code"], "confirmed") << run["best"]["certificate"]["verdict"];
  const auto& models = run["best"]["stability"]["models"];
  EXPECT_EQ(models["media"]["drucker"], nullptr) << "fibres";
  EXPECT_EQ(models["adventitia"]["drucker"]["holds"], true);
  EXPECT_THAT(bench.text("out/stability.csv"),
              AllOf(HasSubstr("\nmedia+adventitia/lm media,"), HasSubstr("\nmedia+adventitia/lm adventitia,")));
  EXPECT_THAT(bench.text("out/evaluations.csv"), HasSubstr("media.mu [kPa]"));

  // What was found predicts what was measured.
  const auto again =
      bench.tunica({"simulate", "experiment.json", "--parameters", "out/result.json", "-o", "predicted"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("run 'media+adventitia/lm' of out/result.json"));
  const auto judged = bench.tunica({"stability", "experiment.json", "--parameters", "out/result.json", "--to", "1.3"});
  ASSERT_EQ(judged.code, 0) << judged.err;
  EXPECT_THAT(judged.out,
              AllOf(HasSubstr("media+adventitia\n"), HasSubstr("\n  model 'media'\n    circumferential strip:"),
                    HasSubstr("\n  model 'adventitia'\n    circumferential strip:")));
}

// The first layer has no fibres; the crimp of those of the second is found there. Without noise, 5 µm and 0.5 mN are
// stated.
TEST_F(Layers, ACauseIsLookedForInEachOfThem) {
  std::swap(bench.experiment["tests"]["tube"]["layers"][0], bench.experiment["tests"]["tube"]["layers"][1]);
  auto& media = bench.experiment["models"]["media"];
  media["mechanisms"] = {{{"type", "fibre_recruitment"}, {"parameters", {{"stretch", {{"initial", 1.2}}}}}}};
  measure();
  media.erase("mechanisms");
  bench.experiment["tests"]["tube"]["data"]["noise"] = {{"outer_diameter", {{"absolute", "5 um"}}},
                                                        {"axial_force", {{"absolute", "0.5 mN"}}}};
  const auto ended = bench.tunica({"diagnose", "experiment.json", "-o", "found", "--quick"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto found = bench.result("found")["diagnosis"];
  EXPECT_THAT(found["ambiguity_set"].dump(), HasSubstr("fibre_recruitment"));
  EXPECT_EQ(found["causes"][0]["target"]["model"], "media") << found["causes"];
  EXPECT_THAT(ended.out, HasSubstr("in the material of 'media'"));
  EXPECT_LT(found["gain"]["after"], 0.1 * found["gain"]["before"].get<double>());
  const auto extended = bench.tunica({"run", "found/extended.json", "-o", "extended"});
  ASSERT_EQ(extended.code, 0) << extended.err;
  EXPECT_TRUE(bench.result("extended")["runs"][0]["best"]["parameters"].contains("media.fibre_recruitment.stretch"));
}

TEST_F(Layers, AreCheckedBeforeARun) {
  measure();
  const auto ended = bench.tunica({"check", "experiment.json"});
  ASSERT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("model media+adventitia, "), HasSubstr("\n  adventitia.mu"),
                               HasSubstr("derivatives are exact")));
}

TEST_F(Layers, StandBesideStripsOfTheRunsOwnModel) {
  measure();
  bench.experiment["tests"]["circ"] = {
      {"type", "uniaxial"},
      {"direction", "circumferential"},
      {"data", {{"file", "circ.csv"}, {"columns", {{"stretch", "stretch"}, {"stress", "stress"}}}}}};
  bench.experiment["runs"] = {{{"model", "adventitia"}, {"optimizer", "lm"}},
                              {{"model", "gho"}, {"optimizer", "lm"}, {"tests", {"circ"}}}};
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto result = bench.result("out");
  EXPECT_TRUE(result["runs"][0]["best"]["parameters"].contains("media.k1"));
  EXPECT_TRUE(result["runs"][0]["best"]["stability"]["models"]["adventitia"]["transverse"][0]["stable"]);
  EXPECT_EQ(result["runs"][0]["best"]["stability"]["models"]["media"]["transverse"][0]["stable"], nullptr)
      << "no strip is made of it";
  EXPECT_TRUE(result["runs"][1]["best"]["parameters"].contains("k1")) << "the only model of its run";
  EXPECT_TRUE(result["runs"][1]["best"]["stability"].contains("transverse"));
  // Names of the run of one model are found among those of all tests, which have layers of others.
  const auto simulated = bench.tunica(
      {"simulate", "experiment.json", "--model", "gho", "--parameters", "out/result.json", "-o", "predicted"});
  ASSERT_EQ(simulated.code, 0) << simulated.err;
  EXPECT_THAT(simulated.err, HasSubstr("gho.k1 = "));
}

TEST_F(Layers, NameTheModelOfASimulationWhereItIsNeeded) {
  EXPECT_THAT(
      refused({"simulate", "experiment.json", "--model", "gho", "-o", "out"}),
      AllOf(HasSubstr("--model gho: serves no test"), HasSubstr("leave --model out, or give media+adventitia")));
  ASSERT_EQ(bench.tunica({"simulate", "experiment.json", "--model", "media+adventitia", "-o", "out"}).code, 0);
  bench.experiment["tests"]["tube"].erase("layers");
  bench.experiment["tests"]["tube"]["thickness"] = 2.06;
  bench.experiment["runs"] = {{{"model", "gho"}, {"optimizer", "lm"}}};
  EXPECT_THAT(refused({"simulate", "experiment.json", "-o", "again"}),
              AllOf(HasSubstr("--model is missing, and there are tests that name no layers"), HasSubstr("adventitia")));
}

TEST_F(Layers, AreRefusedWithTheirPlace) {
  const auto tube = bench.experiment["tests"]["tube"];
  auto& changed = bench.experiment["tests"]["tube"];
  changed["layers"][1]["model"] = "adventita";
  EXPECT_THAT(refused({"check", "experiment.json"}),
              AllOf(HasSubstr("unknown model 'adventita' (/tests/tube/layers/1/model, line "),
                    HasSubstr("Did you mean 'adventitia'?")));
  changed = tube;
  changed["thickness"] = "2 mm";
  EXPECT_THAT(refused({"check", "experiment.json"}),
              HasSubstr("thick_wall_pressurisation: the layers are 2.06 mm thick together, and the wall is 2 mm"));
  changed = tube;
  changed["parameters"] = {{"layer_ratio", {{"initial", 2}}}};
  EXPECT_THAT(
      refused({"check", "experiment.json"}),
      HasSubstr("/tests/tube/parameters/layer_ratio: the parameter 'layer_ratio' means nothing in test 'tube' with "
                "\"layers\"; leave one of them out"));
  changed = tube;
  changed["type"] = "fe_pressurisation";
  changed["length"] = "14 mm";
  changed["elements"] = {1, 6};
  EXPECT_THAT(refused({"check", "experiment.json"}),
              HasSubstr("fe_pressurisation: \"elements\" begins with 1, and the wall has 2 layers, each of which"));
}

/// The same tube, held at its ends: media, adventitia and the opening angle that closed to it.
TEST_F(Layers, AreRecoveredByFiniteElementsWithTheirOpeningAngle) {
  auto& tube = bench.experiment["tests"]["tube"];
  tube["type"] = "fe_pressurisation";
  tube["length"] = "14 mm";
  tube["elements"] = {4, 6};
  tube["parameters"] = {{"opening_angle", {{"initial", 30}, {"min", 0}, {"max", 200}}}};
  std::map<std::string, double> opened = truth;
  opened["tube.opening_angle"] = 80;
  bench.folder.write("truth.json", nlohmann::json(opened).dump());
  const auto simulated = bench.tunica({"simulate", "experiment.json", "--parameters", "truth.json", "-o", "synthetic"});
  ASSERT_EQ(simulated.code, 0) << simulated.err;
  tube["data"]["file"] = "synthetic/tube.csv";
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto parameters = bench.result("out")["runs"][0]["best"]["parameters"];
  for (const auto& [name, value] : opened)
    EXPECT_NEAR(parameters[name]["value"].get<double>(), value, 1e-3 * value) << name;
}

TEST_F(Layers, AreDescribed) {
  const auto ended = bench.tunica({"describe", "thick_wall_pressurisation"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("\n  layers             Layers of the wall from inside"),
                               HasSubstr("list of {\"model\": name, \"thickness\": quantity in mm}")));
}

}  // namespace
