// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

namespace {

/// The paper's set without stabilisation, as a model all of whose parameters but two are fixed.
nlohmann::json set_u() {
  return {{"type", "gho"},
          {"parameters",
           {{"mu", {{"fixed", 10.015}}},
            {"kappa", {{"min", 0}, {"max", 0.3333}, {"initial", 5.1799e-3}}},
            {"k1", {{"fixed", 20.315}}},
            {"k2", {{"min", 0.01}, {"max", 2}, {"initial", 0.17086}, {"scale", "log"}}},
            {"theta", {{"fixed", 45.83}}}}}};
}

}  // namespace

TEST(Stability, JudgesAParameterSetOverTheMeasuredStretchesOrAStatedOne) {
  trial::Bench bench;  // its strips end at 1.4
  bench.experiment["models"]["u"] = set_u();
  const auto measured = bench.tunica({"stability", "experiment.json", "--model", "u"});
  ASSERT_EQ(measured.code, 0) << measured.err;
  EXPECT_THAT(measured.out, AllOf(HasSubstr("circumferential strip: UNSTABLE"), HasSubstr("1.166"),
                                  HasSubstr("measured to 1.4"), HasSubstr("elliptic up to stretch 1.4")));
  const auto stated = bench.tunica({"stability", "experiment.json", "--model", "u", "--to", "1.1"});
  EXPECT_THAT(stated.out, AllOf(Not(HasSubstr("UNSTABLE")), HasSubstr("stable (judged to 1.1); beyond that domain")));
}

TEST(Stability, IsNoVerdictForBiaxialDataUnlessAConstraintStatesARange) {
  trial::Bench bench;
  std::string rows = "stretch,stress\n";
  for (int k = 1; k <= 10; ++k) rows += std::to_string(1 + 0.02 * k) + "," + std::to_string(10 * k) + "\n";
  bench.folder.write("sheet.csv", rows);
  bench.experiment["tests"] = {
      {"sheet",
       {{"type", "biaxial"},
        {"protocol", "equibiaxial"},
        {"data", {{"file", "sheet.csv"}, {"columns", {{"stretch", "stretch"}, {"stress", "stress"}}}}}}}};
  bench.experiment["runs"] = {
      {{"model", "neo"}, {"optimizer", "lm"}},
      {{"model", "neo"},
       {"optimizer", "lm"},
       {"constraints", {{{"type", "transverse_stability"}, {"range", {0.8, 1.5}}, {"directions", {"axial"}}}}}}};
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto result = bench.result("out");
  EXPECT_EQ(result["runs"][0]["best"]["stable"], nullptr);
  EXPECT_EQ(result["runs"][0]["best"]["stability"]["transverse"][1]["stable"], nullptr);
  const auto& stated = result["runs"][1]["best"]["stability"]["transverse"];
  EXPECT_EQ(result["runs"][1]["best"]["stable"], true);
  EXPECT_EQ(stated[0]["stable"], nullptr);
  EXPECT_EQ(stated[1]["measured_from"], 0.8);
  EXPECT_EQ(stated[1]["measured_to"], 1.5);
}

TEST(Stability, DrawsAMapOfTwoParameters) {
  trial::Bench bench;
  bench.experiment["models"]["u"] = set_u();
  const auto ended = bench.tunica({"stability", "experiment.json", "--model", "u", "--map", "kappa", "k2", "--points",
                                   "5", "--to", "1.6", "-o", "map"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out.substr(ended.out.find("map/")), "map/stability.csv\nmap/energy.csv\nmap/stability_map.csv\n");
  const std::string map = bench.text("map/stability_map.csv");
  EXPECT_THAT(map,
              StartsWith("# Transverse stability of free strips from rest to stretch 1.6.\nkappa [1],k2 [1],stable,"));
  EXPECT_EQ(std::count(map.begin(), map.end(), '\n'), 2 + 25);
  EXPECT_THAT(map, HasSubstr("\n0,0.01,0,"));         // no dispersion: unstable
  EXPECT_THAT(map, HasSubstr("\n0.3333,0.01,1,,,"));  // isotropic: stable
}

TEST(Stability, RefusesMapsItCannotDraw) {
  trial::Bench bench;
  bench.experiment["models"]["u"] = set_u();
  const auto refused = [&](std::vector<std::string> more) {
    std::vector<std::string> command{"stability", "experiment.json", "--model", "u"};
    command.insert(command.end(), more.begin(), more.end());
    const auto ended = bench.tunica(command);
    EXPECT_EQ(ended.code, 2) << ended.out;
    return ended.err;
  };
  EXPECT_THAT(refused({"--map", "kappa", "k2"}), HasSubstr("-o DIR"));
  std::filesystem::create_directory(bench.path("taken"));
  bench.folder.write("taken/file", "");
  const auto taken = bench.tunica({"stability", "experiment.json", "--model", "u", "-o", "taken"});
  EXPECT_EQ(taken.code, 2);
  EXPECT_EQ(taken.out, "") << "no verdict before the refusal";
  EXPECT_THAT(refused({"--map", "kappa", "k3", "-o", "a"}), HasSubstr("Did you mean 'k2'?"));
  EXPECT_THAT(refused({"--map", "kappa", "mu", "-o", "b"}), HasSubstr("'mu' is fixed at 10.015"));
  EXPECT_THAT(refused({"--map", "kappa", "kappa", "-o", "c"}), HasSubstr("named twice"));
}

TEST(Stability, SaysWhoseParametersItTakesAndTakesThoseOfANamedRun) {
  trial::Bench bench;
  bench.experiment["runs"] = {{{"model", "neo"}, {"optimizer", "lm"}}, {{"model", "neo"}, {"optimizer", "es"}}};
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  for (const std::string verb : {"stability", "simulate"}) {
    const auto asked = [&](std::vector<std::string> more) {
      std::vector<std::string> command{verb, "experiment.json", "--model", "neo"};
      command.insert(command.end(), more.begin(), more.end());
      if (verb == "simulate") command.insert(command.end(), {"-o", "simulated" + more.back().substr(0, 3)});
      return bench.tunica(command);
    };
    const std::string file = "out/result.json";
    const auto best = asked({"--parameters", file}), named = asked({"--run", "neo/es", "--parameters", file});
    EXPECT_THAT(best.out + best.err, HasSubstr("run 'neo/lm' of out/result.json: mu = "));
    EXPECT_EQ(named.code, verb == "simulate" ? 2 : 0) << "the folder is there already";
    EXPECT_THAT(named.out + named.err, HasSubstr("run 'neo/es' of out/result.json: mu = "));
    const auto unknown = asked({"--parameters", file, "--run", "neo/ex"});
    EXPECT_EQ(unknown.code, 2);
    EXPECT_THAT(unknown.err,
                HasSubstr("no run 'neo/ex' of the model 'neo' has a result in it. Did you mean 'neo/es'?"));
    EXPECT_THAT(asked({"--run", "neo/es"}).err, HasSubstr("name that with --parameters"));
    bench.folder.write("p.json", R"({"mu": -5})");
    EXPECT_THAT(asked({"--run", "neo/es", "--parameters", "p.json"}).err, HasSubstr("is not a result.json"));
  }
  EXPECT_THAT(bench.tunica({"stability", "experiment.json", "--model", "neo", "--parameters", "p.json"}).err,
              HasSubstr("warning: mu = -5 kPa lies outside "));
}

TEST(Stability, BoundsBeyondTheDeclaredRangeAreWarnedOf) {
  trial::Bench bench;
  bench.experiment["models"]["gho"]["parameters"]["kappa"] = {{"min", -0.2}, {"max", 0.9}};
  const auto ended = bench.tunica({"check", "experiment.json"});
  EXPECT_THAT(ended.out, HasSubstr("! parameter 'kappa': its bounds -0.2 … 0.9 go beyond 0 … 0.3333"));
  EXPECT_THAT(ended.out, Not(HasSubstr("parameter 'mu'")));
}

TEST(Stability, IsReportedOfEveryRunAskedForOrNot) {
  trial::Bench bench;
  bench.experiment["models"]["u"] = set_u();
  bench.experiment["runs"] = {
      {{"model", "neo"}, {"optimizer", "lm"}},
      {{"model", "gho"}, {"optimizer", "lm"}, {"constraints", {{{"type", "transverse_stability"}, {"h", 0.7}}}}}};
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("Transverse stability"));
  const auto result = bench.result("out");
  const auto& rubber = result["runs"][0]["best"];
  EXPECT_EQ(rubber["stable"], true);
  EXPECT_EQ(rubber["stability"]["imposed"], nullptr);
  EXPECT_EQ(rubber["stability"]["drucker"]["holds"], true);
  const auto& fibres = result["runs"][1]["best"];
  EXPECT_EQ(fibres["status"], "ok");
  EXPECT_EQ(fibres["stability"]["imposed"], "h = 0.7");
  EXPECT_EQ(fibres["stability"]["drucker"], nullptr);
  EXPECT_THAT(bench.text("out/stability.csv"), HasSubstr("neo/lm,axial,1.4,"));
  EXPECT_THAT(bench.text("out/energy.csv"), HasSubstr("gho/lm,1.4,1.4,"));
}

TEST(Stability, IsJudgedFurtherAndMappedWhereTheExperimentAsks) {
  trial::Bench bench;
  bench.experiment["analysis"]["stability"] = {{"to", 2}, {"map", {"kappa", "k2"}}, {"points", 4}};
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto result = bench.result("out");
  EXPECT_EQ(result["runs"][0]["best"]["stability"]["ellipticity"]["checked_to"], 2);
  const std::string map = bench.text("out/stability_map_gho-es.csv");
  EXPECT_EQ(std::count(map.begin(), map.end(), '\n'), 2 + 16);
  EXPECT_FALSE(std::filesystem::exists(bench.path("out/stability_map_neo-lm.csv")));  // has neither

  bench.experiment["analysis"]["stability"]["map"] = {"kappa", "k3"};
  const auto checked = bench.tunica({"check", "experiment.json"});
  EXPECT_EQ(checked.code, 2) << "what run refuses, check does not pass";
  const auto refused = bench.tunica({"run", "experiment.json", "-o", "never"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err, checked.err);
  EXPECT_THAT(refused.err, HasSubstr("experiment.json (/analysis/stability/map/1, line "));
  EXPECT_THAT(refused.err,
              HasSubstr("no run searches for the parameter 'k3' of the stability map. Did you mean 'k1'?"));
  const auto never = [&](const nlohmann::json& names) {
    bench.experiment["analysis"]["stability"]["map"] = names;
    const auto ended_at_once = bench.tunica({"run", "experiment.json", "-o", "never"});
    EXPECT_EQ(ended_at_once.code, 2);
    EXPECT_FALSE(std::filesystem::exists(bench.path("never")));
    return ended_at_once.err;
  };
  EXPECT_THAT(never({"k2", "k2"}), HasSubstr("'k2' is named twice in the stability map"));
  bench.experiment["models"]["gho"]["parameters"]["kappa"] = {{"fixed", 0.1}};
  bench.experiment["models"]["other"] = {{"type", "gho"}, {"parameters", {{"k2", {{"fixed", 1}}}}}};
  bench.experiment["runs"].push_back({{"model", "other"}, {"optimizer", "lm"}});
  EXPECT_THAT(never({"kappa", "k2"}), HasSubstr("no run searches for both 'kappa' and 'k2'"));
}
