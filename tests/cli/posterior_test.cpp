// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include <gmock/gmock.h>
#include <signal.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::HasSubstr;

TEST(PosteriorOfARun, IsDrawnAlsoWhenTheRunHasFinished) {
  trial::Bench bench;
  bench.experiment["runs"][1] = {{"model", "gho"}, {"optimizer", "lm"}};
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  const auto before = bench.text("out/evaluations.csv");
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out", "--resume", "--posterior=800"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(bench.text("out/evaluations.csv"), before);
  EXPECT_THAT(ended.out, HasSubstr("posterior ("));
  const auto best = bench.result("out")["runs"][0]["best"];
  EXPECT_EQ(best["posterior"]["draws"], 800);
  EXPECT_EQ(best["posterior"]["chains"], 4);
  const auto& mu = best["parameters"]["mu"];
  EXPECT_LT(mu["posterior_ci95"][0], mu["posterior"]["median"]);
  EXPECT_GT(mu["posterior_ci95"][1], mu["posterior"]["median"]);
  const std::string file = "out/" + best["posterior"]["file"].get<std::string>();
  const auto draws = nlohmann::json::parse(bench.text(file));
  for (const auto* name : {"lp", "acceptance_rate"}) EXPECT_EQ(draws["sample_stats"][name].size(), 4u);
  double sum = 0;
  for (const auto& chain : draws["posterior"]["mu"]) {
    ASSERT_EQ(chain.size(), 200u);
    for (const auto& value : chain) sum += value.get<double>() / 800;
  }
  EXPECT_NEAR(sum, mu["posterior"]["mean"], 1e-9 * sum);
  const std::string page = bench.text("out/report.html");
  EXPECT_THAT(page, HasSubstr("Posterior of"));
  // The same for another number of threads.
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "one", "-j", "1", "--posterior=800"}).code, 0);
  EXPECT_EQ(bench.text("one" + file.substr(3)), bench.text(file));
}

TEST(PosteriorOfARun, AllowsForASmoothMisfit) {
  trial::Bench bench;
  bench.experiment["runs"] = {{{"model", "neo"}, {"optimizer", "lm"}}};
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out", "--discrepancy", "--posterior=800"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto result = bench.result("out");
  const auto& found = result["runs"][0]["best"]["posterior"];
  EXPECT_EQ(found["draws"], 800);
  const auto& misfit = found["discrepancy"];
  EXPECT_LE(misfit["ci95"][0], misfit["median"]);
  EXPECT_LE(misfit["median"], misfit["ci95"][1]);
  EXPECT_GE(misfit["none"], 0);
  EXPECT_LE(misfit["none"], 1);
  EXPECT_THAT(result["runs"][0]["best"]["uncertainty"].dump(), HasSubstr("a smooth misfit beside the model"));
  EXPECT_EQ(nlohmann::json::parse(bench.text("out/input.json"))["analysis"]["posterior"]["discrepancy"], true);
}

// What a run leaves that is killed while its chains are drawn: they are drawn anew, to the same bits.
TEST(PosteriorOfARun, IsDrawnAnewWhereItWasInterrupted) {
  trial::Bench bench;
  bench.experiment["analysis"]["posterior"]["draws"] = 400;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  const std::string file = "out/" + bench.result("out")["runs"][0]["best"]["posterior"]["file"].get<std::string>();
  const auto draws = bench.text(file);
  std::filesystem::remove(bench.path("out/result.json"));
  std::filesystem::remove(bench.path(file));
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out", "--resume"}).code, 0);
  EXPECT_EQ(bench.text(file), draws);
}

// A process that is killed at some moment while chains are drawn, twice: the draws are those of a run that never was.
TEST(PosteriorOfARun, IsTheSameToTheBitAfterItsProcessWasKilled) {
  trial::Bench bench;
  bench.experiment["analysis"]["posterior"] = {{"draws", 8000}, {"discrepancy", true}};
  bench.save();
  const auto run = [&](const std::string& output, bool resume) {
    std::vector<std::string> words{"run", "experiment.json", "-o", output, "-j", "2", "--no-certificate"};
    if (resume) words.push_back("--resume");
    return trial::tunica_command(words);
  };
  ASSERT_EQ(trial::Process(run("whole", false), bench.folder.path()).wait().code, 0);
  const std::string file = bench.result("whole")["runs"][0]["best"]["posterior"]["file"];
  for (const bool resume : {false, true}) {
    trial::Process process(run("killed", resume), bench.folder.path());
    // Chains are drawn once the journal of the search is whole.
    const auto searched = std::filesystem::file_size(bench.path("whole/evaluations.csv"));
    for (int attempt = 0; attempt < 3000; ++attempt) {
      std::error_code none;
      if (std::filesystem::file_size(bench.path("killed/evaluations.csv"), none) + 200 >= searched && !none) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    ASSERT_FALSE(std::filesystem::exists(bench.path("killed/" + file))) << "killed too late";
    process.signal(SIGKILL);
    EXPECT_EQ(process.wait().code, 128 + SIGKILL);
  }
  ASSERT_EQ(trial::Process(run("killed", true), bench.folder.path()).wait().code, 0);
  EXPECT_TRUE(bench.text("killed/" + file) == bench.text("whole/" + file));
  EXPECT_EQ(trial::without_times(bench.result("killed")), trial::without_times(bench.result("whole")));
}

// The linearised limits are compared here once more, from what result.json says.
TEST(PosteriorOfARun, WarnsOfShortChainsAndOfLimitsElsewhere) {
  trial::Bench bench;
  bench.experiment["runs"][1] = {{"model", "gho"}, {"optimizer", "lm"}};
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out", "--posterior=400"}).code, 0);
  const auto result = bench.result("out");
  int short_chains = 0, elsewhere = 0;
  for (const auto& run : result["runs"]) {
    const auto& best = run["best"];
    const auto told = [&](const char* kind) {
      return std::any_of(result["warning_details"].begin(), result["warning_details"].end(),
                         [&](const auto& warning) { return warning["kind"] == kind && warning["run"] == run["run"]; });
    };
    bool differs = false;
    for (const auto& parameter : best["parameters"]) {
      const auto &linear = parameter["ci95"], &drawn = parameter["posterior_ci95"];
      if (linear.is_null()) continue;
      const double half = (linear[1].get<double>() - linear[0].get<double>()) / 2;
      for (const std::size_t end : {0, 1})
        differs = differs || std::abs(linear[end].get<double>() - drawn[end].get<double>()) > half / 2;
    }
    const bool settled = best["posterior"]["converged"].get<bool>();
    EXPECT_EQ(told("posterior_not_converged"), !settled) << run["run"];
    EXPECT_EQ(told("posterior_disagrees"), differs && settled) << run["run"] << ": rough quantiles judge nothing";
    short_chains += told("posterior_not_converged");
    elsewhere += told("posterior_disagrees");
  }
  EXPECT_GT(short_chains, 0) << "400 draws are worth fewer";
  RecordProperty("elsewhere", elsewhere);
}
