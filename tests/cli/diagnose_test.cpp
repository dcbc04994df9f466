// SPDX-License-Identifier: Apache-2.0
// The files that `tunica diagnose` leaves behind, and those that it does not.
#include <chrono>
#include <cmath>
#include <random>
#include <regex>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

/// The two strips with their noise stated, and one run.
struct Diagnosed : trial::Bench {
  Diagnosed() {
    for (const char* test : {"circ", "axial"}) experiment["tests"][test]["data"]["noise"] = {{"absolute", "0.2 kPa"}};
    experiment["runs"] = {{{"model", "gho"}, {"optimizer", "lm"}}};
    save();
  }
};

}  // namespace

TEST(Diagnose, TellsItsStagesInPlainLinesWhereStderrIsAFile) {
  const Diagnosed bench;
  const auto ended = bench.tunica({"diagnose", "experiment.json", "-o", "out", "--quick"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err,
              AllOf(HasSubstr("  5 %  fitting the base model\n"), Not(HasSubstr("\r")), Not(HasSubstr("\033"))));
  EXPECT_THAT(ended.out, AllOf(HasSubstr("Verdict: "), Not(HasSubstr("\033"))));
  EXPECT_TRUE(std::filesystem::exists(bench.path("out/result.json")));
}

TEST(Diagnose, BeginsWithTheSizeThatARunSays) {
  Diagnosed bench;
  // The strips are softer than this matrix can be.
  bench.experiment["models"]["gho"]["parameters"]["mu"] = {{"fixed", "30 kPa"}};
  bench.experiment["diagnosis"] = {{"tolerance", "3 %"}};
  auto ended = bench.tunica({"run", "experiment.json", "-o", "run"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto size = bench.result("run")["runs"][0]["best"]["misfit_size"];
  ended = bench.tunica({"diagnose", "experiment.json", "-o", "out", "--quick"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto budget = bench.result("out")["diagnosis"]["budget"];
  ASSERT_GT(size["rms"], 0.0995);
  EXPECT_NEAR(size["rms"].get<double>(), budget["rms"].get<double>(), 1e-5);
  EXPECT_NEAR(size["rms_upper"].get<double>(), budget["rms_upper"].get<double>(), 1e-5);
  EXPECT_EQ(size["channels"].size(), 2u);
  EXPECT_EQ(size["channels"][0]["range"], budget["channels"][0]["range"]);
  EXPECT_NEAR(size["tolerance"].get<double>(), 0.03, 1e-12);
  const std::string words = fmt::format("misses by {:.0f} % of the range", 100 * size["rms"].get<double>());
  EXPECT_THAT(trial::text_of(bench.path("run/report.html")), HasSubstr(words));
}

TEST(Diagnose, LeavesNoFolderAfterAnError) {
  Diagnosed bench;
  for (const char* test : {"circ", "axial"})
    bench.experiment["tests"][test]["data"]["noise"] = {{"absolute", "200 kPa"}};
  bench.experiment["models"]["gho"]["parameters"]["k2"] = {{"fixed", 1e6}};  // exp(k2 E²) beyond all numbers
  auto ended = bench.tunica({"diagnose", "experiment.json"});
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_THAT(
      ended.err,
      AllOf(HasSubstr("error: diagnosis: the base model cannot be evaluated from any of"),
            HasSubstr("Run `tunica check experiment.json`, which evaluates the initial point and shows what fails")));
  EXPECT_FALSE(std::filesystem::exists(bench.path("results")));
  // A folder that was there before stays.
  std::filesystem::create_directory(bench.path("mine"));
  ended = bench.tunica({"diagnose", "experiment.json", "-o", "mine"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_TRUE(std::filesystem::is_empty(bench.path("mine")));
}

TEST(Diagnose, LeavesNoFolderAfterCtrlC) {
  const Diagnosed bench;
  trial::Process process(trial::tunica_command({"diagnose", "experiment.json", "-j", "1"}), bench.folder.path());
  // It writes nothing before its end; the folder itself says that it is under way.
  for (int attempt = 0; attempt < 5000 && !std::filesystem::exists(bench.path("results/bench-1")); ++attempt)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_TRUE(std::filesystem::exists(bench.path("results/bench-1")));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  process.signal(SIGINT);
  const auto ended = process.wait();
  if (ended.code == 0) GTEST_SKIP() << "it came to its end before the signal";
  EXPECT_EQ(ended.code, 130) << ended.err;
  EXPECT_THAT(ended.err,
              AllOf(HasSubstr("interrupted; an unfinished diagnosis leaves nothing behind"), Not(HasSubstr("\033"))));
  EXPECT_EQ(ended.out, "");
  EXPECT_FALSE(std::filesystem::exists(bench.path("results")));
}

/// White noise of 1.09 times the stated size, 1000 rows (seed 11): χ² contradicts the statement, and no shape does.
TEST(Diagnose, JudgesAMisfitInTheWordsOfARun) {
  trial::Bench bench;
  std::mt19937_64 random(11);
  const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
  std::vector<double> noise(1000);
  double squares = 0;
  for (double& one : noise) {
    one = std::sqrt(-2 * std::log(uniform())) * std::cos(2 * M_PI * uniform());
    squares += one * one / 1000;
  }
  std::string rows = "stretch [1],stress [kPa]\n";
  for (std::size_t k = 0; k < noise.size(); ++k) {
    const double l = 1.01 + 0.0004 * static_cast<double>(k);
    rows += fmt::format("{},{}\n", l, 30 * (l * l - 1 / l) + 0.3 * noise[k] * std::sqrt(1.18 / squares));
  }
  bench.folder.write("circ.csv", rows);
  bench.experiment["tests"].erase("axial");
  bench.experiment["tests"]["circ"]["data"]["noise"] = {{"absolute", 0.3}};
  bench.experiment["objective"] = "standardised_quadratic";
  bench.experiment["runs"] = {{{"model", "neo"}, {"optimizer", "lm"}}};
  const std::string words = "times the stated noise: a small misfit, and a real one (chance ";
  const auto plain = [](std::string text) { return std::regex_replace(text, std::regex("\\s+"), " "); };

  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "run"}).code, 0);
  const auto judged = bench.result("run")["runs"][0]["best"]["misfit"];
  EXPECT_TRUE(judged["small_but_real"].get<bool>());
  const auto ended = bench.tunica({"diagnose", "experiment.json", "--quick", "-o", "diagnosis"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(plain(ended.out),
              HasSubstr("NOTHING DETECTED: no mechanism and no smooth shape stands out, and yet χ²/ν"));
  EXPECT_THAT(plain(ended.out), HasSubstr(words));
  const auto diagnosis = bench.result("diagnosis")["diagnosis"];
  EXPECT_EQ(diagnosis["reason_codes"], nlohmann::json({"residuals_like_noise", "rows_miss_the_model"}));
  for (const char* key : {"chi_square", "degrees_of_freedom", "chance"})
    EXPECT_NEAR(diagnosis["base"]["misfit"][key].get<double>(), judged[key].get<double>(),
                1e-3 * judged[key].get<double>())
        << key;
  EXPECT_THAT(bench.text("diagnosis/report.html"), HasSubstr("Nothing detected: no mechanism and no smooth shape"));
}

TEST(Run, SendsNoConstrainedFitToADiagnosisThatDropsTheConstraint) {
  trial::Bench bench;
  bench.experiment["runs"] = {{{"model", "gho"}, {"optimizer", "lm"}},
                              {{"model", "gho"}, {"optimizer", "lm"}, {"constraints", nlohmann::json::array()}}};
  bench.experiment["constraints"] = {{{"type", "transverse_stability"}, {"h", 0.7}}};
  for (auto& test : bench.experiment["tests"]) test["data"]["noise"] = {{"absolute", 0.05}};
  bench.tunica({"run", "experiment.json", "-o", "out"});
  std::size_t constrained = 0, free = 0;
  const auto result = bench.result("out");
  for (const auto& warning : result["warning_details"]) {
    if (warning["kind"] != "noise_contradicted") continue;
    const std::string said = warning["sentence"];
    if (warning["run"] == "gho/lm") {
      ++constrained;
      EXPECT_THAT(said,
                  HasSubstr("Fit once without the constraints (h = 0.7), \"constraints\": []. What misfit is left "
                            "then is for tunica diagnose experiment.json to explain, which drops them"));
    } else {
      ++free;
      EXPECT_THAT(said, HasSubstr(". Run tunica diagnose experiment.json"));
    }
  }
  EXPECT_EQ(constrained, 1u) << result["warning_details"].dump(1);
  EXPECT_EQ(free, 1u);
}
