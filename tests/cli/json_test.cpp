// SPDX-License-Identifier: Apache-2.0
// What scripts read: one JSON document on stdout, and nothing else there.
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "cli/bench.hpp"

using namespace tunica;
using nlohmann::json;
using ::testing::HasSubstr;

namespace {

const trial::Folder json_folder;

/// What the command prints, parsed; throws where that is not exactly one JSON document.
json printed(const std::vector<std::string>& arguments) {
  const auto ended = trial::tunica(arguments, json_folder.path());
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  return json::parse(ended.out);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST(Json, OfListNamesWhatIsThereAndItsPlugins) {
  const json all = printed({"list", "--json"});
  for (const char* shelf : {"models", "tests", "optimizers", "mechanisms"}) {
    ASSERT_FALSE(all.at(shelf).empty()) << shelf;
    for (const auto& one : all.at(shelf))
      for (const char* key : {"name", "doc", "reference", "plugin"}) EXPECT_TRUE(one.at(key).is_string()) << one;
  }
  EXPECT_TRUE(std::any_of(all.at("plugins").begin(), all.at("plugins").end(),
                          [](const json& plugin) { return plugin.at("name") == "gho" && plugin.contains("file"); }));
  EXPECT_EQ(all.at("refused"), json::array());
  const json models = printed({"list", "models", "--json"});
  EXPECT_EQ(models.at("models"), all.at("models"));
  EXPECT_FALSE(models.contains("tests"));
}

TEST(Json, ListWithNamesIsALineEach) {
  const json all = printed({"list", "--json"});
  std::vector<std::string> names;
  for (const char* shelf : {"models", "tests", "optimizers", "mechanisms"})
    for (const auto& one : all.at(shelf)) names.push_back(one.at("name"));
  EXPECT_EQ(lines_of(trial::tunica({"list", "--names"}, json_folder.path()).out), names);
}

TEST(Json, OfDescribeHasWhatTheObjectDeclares) {
  const json gho = printed({"describe", "gho", "--json"}).at("model");
  EXPECT_EQ(gho.at("name"), "gho");
  const auto mu = std::find_if(gho.at("parameters").begin(), gho.at("parameters").end(),
                               [](const json& parameter) { return parameter.at("name") == "mu"; });
  ASSERT_NE(mu, gho.at("parameters").end());
  EXPECT_EQ(mu->at("unit"), "kPa");
  EXPECT_LT(mu->at("min").get<double>(), mu->at("max").get<double>());
  const json strip = printed({"describe", "uniaxial", "--json"}).at("test");
  EXPECT_EQ(strip.at("observables").at(0).at("name"), "stretch");
  EXPECT_EQ(strip.at("observables").at(0).at("role"), "prescribed");
  EXPECT_EQ(printed({"describe", "ceres_lm", "--json"}).at("optimizer").at("needs").at("residuals"), true);
  const json offset = printed({"describe", "force_offset", "--json"}).at("mechanism");
  EXPECT_EQ(offset.at("null"), 0);
  EXPECT_FALSE(offset.at("look_alikes").empty());
}

TEST(Json, OfCheckHasTheSetUpAndItsVerdict) {
  const trial::Bench bench;
  const auto ended = bench.tunica({"check", "experiment.json", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const json checked = json::parse(ended.out);
  EXPECT_EQ(checked.at("name"), "bench");
  EXPECT_EQ(checked.at("in_order"), true);
  EXPECT_EQ(checked.at("runs").at(1).at("realisations"), 3);
  ASSERT_EQ(checked.at("problems").size(), 2u);
  const json& problem = checked.at("problems").at(0);
  EXPECT_EQ(problem.at("tests"), json::parse(R"(["axial", "circ"])"));
  EXPECT_EQ(problem.at("channels").at(0).at("rows"), 20);
  EXPECT_EQ(problem.at("parameters").at("mu").at("unit"), "kPa");
  EXPECT_EQ(problem.at("initial").at("status"), "ok");
  EXPECT_GT(problem.at("initial").at("objective"), 0);
  EXPECT_TRUE(problem.at("initial").at("identifiability").is_array());
}

TEST(Json, OfCheckSaysWhenTheInitialPointFails) {
  trial::Bench bench;
  // exp of k2 (λ² − 1)² beyond all numbers at the largest stretch.
  bench.experiment["models"]["gho"]["parameters"]["k2"] = {{"min", 1}, {"max", 1e6}, {"initial", 1e6}};
  const auto ended = bench.tunica({"check", "experiment.json", "--json"});
  EXPECT_EQ(ended.code, 1) << ended.err;
  const json checked = json::parse(ended.out);
  EXPECT_EQ(checked.at("in_order"), false);
  EXPECT_THAT(checked.at("problems").at(1).at("initial").at("status").get<std::string>(), HasSubstr("failed: "));
}

TEST(Json, OfStabilityIsThatOfAResult) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  const auto ended = bench.tunica(
      {"stability", "experiment.json", "--model", "neo", "--parameters", "out/result.json", "-o", "map", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const json judged = json::parse(ended.out);
  const json best = bench.result("out").at("runs").at(0).at("best");
  EXPECT_EQ(judged.at("stable"), best.at("stable"));
  EXPECT_EQ(judged.at("stability").at("transverse"), best.at("stability").at("transverse"));
  EXPECT_EQ(judged.at("parameters").at("mu").at("value"), best.at("parameters").at("mu").at("value"));
  EXPECT_EQ(judged.at("files"), json::parse(R"(["map/stability.csv", "map/energy.csv"])"));
}

TEST(Json, OfDataHasTheRowsThatAFitTakes) {
  trial::Bench bench;
  // Units are base units; a stress stays in the measure of its file, and predictions are brought to that.
  auto& data = bench.experiment["tests"]["circ"]["data"];
  data["stress_measure"] = "first_piola_kirchhoff";
  data["rows"] = "0:20:2";
  bench.experiment["tests"]["circ"]["hold_out"] = "1:2";
  bench.folder.write("circ.csv", "stretch [1],stress [Pa]\n1.1,1000\n1.2,2000\n1.3,3000\n1.4,4000\n");
  const auto ended = bench.tunica({"data", "experiment.json", "--json", "-o", "rows"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const json taken = json::parse(ended.out).at("tests").at("circ");
  EXPECT_EQ(taken.at("columns").at("stretch [1]"), json::parse("[1.1, 1.3]"));
  EXPECT_DOUBLE_EQ(taken.at("columns").at("stress [kPa]").at(1).get<double>(), 3);
  EXPECT_EQ(taken.at("columns").at("held_out [1]"), json::parse("[0, 1]"));
  EXPECT_EQ(taken.at("lines"), json::parse("[2, 4]"));
  EXPECT_EQ(taken.at("prescribed"), json::parse(R"(["stretch"])"));
  EXPECT_TRUE(std::filesystem::exists(bench.folder.path() / "rows/axial.csv"));
}

TEST(Json, OfCertifyHasEveryRun) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out", "--no-certificate"}).code, 0);
  const auto ended = bench.tunica({"certify", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(json::parse(ended.out).at("runs").size(), 2u);
}

TEST(Json, LeavesErrorsOnStderr) {
  const auto ended = trial::tunica({"describe", "unaxial", "--json"}, json_folder.path());
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.out, "");
  EXPECT_THAT(ended.err, HasSubstr("Did you mean 'uniaxial'?"));
}
