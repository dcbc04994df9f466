// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <zlib.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::HasSubstr;
using ::testing::Not;

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

TEST(PosteriorOfARun, WarnsWhereADiscrepancyTakesTheNoiseForKnown) {
  trial::Bench bench;
  bench.experiment["runs"] = {{{"model", "neo"}, {"optimizer", "lm"}}};
  const auto warned = [&bench](const std::string& output) {
    EXPECT_EQ(bench.tunica({"run", "experiment.json", "-o", output, "--discrepancy", "--posterior=400"}).code, 0);
    return bench.result(output)["warning_details"].dump().find("posterior_noise_assumed") != std::string::npos;
  };
  EXPECT_FALSE(warned("all"));
  for (auto& test : bench.experiment["tests"]) test["hold_out"] = "6:20";
  EXPECT_TRUE(warned("few"));
}

namespace {

std::vector<std::string> rows_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A run with 400 draws, and what a killed one leaves of it: no result, no draws, but their steps.
struct KilledRun {
  KilledRun() {
    bench.experiment["analysis"]["posterior"]["draws"] = 400;
    if (bench.tunica({"run", "experiment.json", "-o", "out"}).code != 0) throw std::runtime_error("no run");
    file = "out/" + bench.result("out")["runs"][0]["best"]["posterior"]["file"].get<std::string>();
    steps = "out/posterior_steps_" + file.substr(14, file.size() - 19) + ".csv";
    draws = bench.text(file);
    result = trial::without_times(bench.result("out"));
    std::filesystem::remove(bench.path("out/result.json"));
    std::filesystem::remove(bench.path(file));
  }
  [[nodiscard]] trial::Ended resume() { return bench.tunica({"run", "experiment.json", "-o", "out", "--resume"}); }
  /// The cell `column` of a line gets another value, and the line the checksum of what it then says.
  void change(std::size_t line, std::size_t column, const std::string& value) {
    auto lines = rows_of(bench.text(steps));
    std::vector<std::string> cells;
    std::istringstream stream(lines.at(line));
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    cells.at(column) = value;
    std::string changed;
    for (std::size_t k = 0; k + 1 < cells.size(); ++k) changed += (k > 0 ? "," : "") + cells[k];
    const auto crc = ::crc32_z(0, reinterpret_cast<const Bytef*>(changed.data()), changed.size());
    lines[line] = fmt::format("{},{:08x}", changed, crc);
    bench.folder.write(steps, fmt::format("{}\n", fmt::join(lines, "\n")));
  }

  trial::Bench bench;
  std::string file, steps, draws;
  nlohmann::json result;
};

}  // namespace

TEST(PosteriorOfARun, GoesOnFromItsStepsWhereverTheirLastLineWasCut) {
  KilledRun run;
  const std::string whole = run.bench.text(run.steps);
  EXPECT_EQ(rows_of(whole).size(), 2u + 4 * 600);
  for (const double share : {0.0, 0.1, 0.6, 0.999}) {
    run.bench.folder.write(run.steps,
                           whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    ASSERT_EQ(run.resume().code, 0);
    EXPECT_TRUE(run.bench.text(run.file) == run.draws) << share;
    EXPECT_EQ(trial::without_times(run.bench.result("out")), run.result) << share;
    EXPECT_EQ(rows_of(run.bench.text(run.steps)).size(), 2u + 4 * 600) << share;
  }
}

// A draw that was kept is taken as it was: here with an acceptance that no move has.
TEST(PosteriorOfARun, DoesNotDrawAgainWhatIsKept) {
  KilledRun run;
  const auto lines = rows_of(run.bench.text(run.steps));
  const auto first =
      std::find_if(lines.begin(), lines.end(), [](const auto& line) { return line.starts_with("1,501,"); });
  ASSERT_NE(first, lines.end());
  run.change(static_cast<std::size_t>(first - lines.begin()), 3, "0.123");
  ASSERT_EQ(run.resume().code, 0);
  EXPECT_EQ(nlohmann::json::parse(run.bench.text(run.file))["sample_stats"]["acceptance_rate"][0][0], 0.123);
}

TEST(PosteriorOfARun, DrawsAgainAfterADamagedStep) {
  KilledRun run;
  std::string damaged = run.bench.text(run.steps);
  char& digit = damaged[damaged.find("\n1,550,") + 9];
  digit = digit == '7' ? '8' : '7';
  run.bench.folder.write(run.steps, damaged);
  ASSERT_EQ(run.resume().code, 0);
  EXPECT_TRUE(run.bench.text(run.file) == run.draws);
  EXPECT_EQ(trial::without_times(run.bench.result("out")), run.result);
}

// Steps of another program, or of other plugins, are not those that this one would make.
TEST(PosteriorOfARun, DrawsAgainWhatAnotherProgramDrew) {
  KilledRun run;
  std::string other = run.bench.text(run.steps);
  const auto name = other.find("# tunica ");
  ASSERT_EQ(name, 0u) << other.substr(0, 80);
  EXPECT_THAT(other.substr(0, other.find('\n')), HasSubstr("ceres_lm "));
  other.replace(9, 1, "9");
  run.bench.folder.write(run.steps, other);
  run.change(3, 3, "0.123");  // a step that is not drawn again would keep it
  ASSERT_EQ(run.resume().code, 0);
  EXPECT_TRUE(run.bench.text(run.file) == run.draws);
  EXPECT_THAT(run.bench.text(run.steps), Not(HasSubstr(",0.123,")));
}

TEST(PosteriorOfARun, SaysWhatAFullDiskKeptAndGoesOnFromThere) {
  KilledRun run;
  const std::size_t whole = run.bench.text(run.steps).size();
  run.bench.folder.write(run.steps, "");
  // No file of this process beyond 200 KiB: the tables fit, the steps do not. That is what a full disk looks like;
  // counts of lines go nowhere.
  ASSERT_GT(whole, 204'800u);
  std::string line = "ulimit -f 200; GCOV_PREFIX=/dev/null";
  for (const auto& word : trial::tunica_command({"run", "experiment.json", "-o", "out", "--resume"}))
    line += " '" + word + "'";
  const auto stopped = trial::Process({"/bin/bash", "-c", line}, run.bench.folder.path()).wait();
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("posterior_steps_"));
  EXPECT_THAT(stopped.err, HasSubstr("cannot write: "));
  EXPECT_THAT(stopped.err, ::testing::ContainsRegex("steps? of the chains are kept there. Then go on with"));
  EXPECT_THAT(stopped.err, HasSubstr("--resume"));
  ASSERT_EQ(run.resume().code, 0);
  EXPECT_TRUE(run.bench.text(run.file) == run.draws);
  EXPECT_EQ(trial::without_times(run.bench.result("out")), run.result);
}

// A density that the point no longer has says that another material or other data were drawn from.
TEST(PosteriorOfARun, DrawsAgainWhereTheDensityIsAnotherOne) {
  KilledRun run;
  const auto lines = rows_of(run.bench.text(run.steps));
  const auto last =
      std::find_if(lines.begin(), lines.end(), [](const auto& line) { return line.starts_with("2,600,"); });
  ASSERT_NE(last, lines.end());
  run.change(static_cast<std::size_t>(last - lines.begin()), 2, "-1.5");
  ASSERT_EQ(run.resume().code, 0);
  EXPECT_TRUE(run.bench.text(run.file) == run.draws);
}

TEST(PosteriorOfARun, DrawsMoreOfAFinishedRunBehindWhatItHas) {
  KilledRun run;
  const std::string before = run.bench.text(run.steps);
  ASSERT_EQ(run.bench.tunica({"run", "experiment.json", "-o", "out", "--resume", "--posterior=800"}).code, 0);
  EXPECT_TRUE(run.bench.text(run.steps).starts_with(before));
  const auto few = nlohmann::json::parse(run.draws)["posterior"]["mu"];
  const auto many = nlohmann::json::parse(run.bench.text(run.file))["posterior"]["mu"];
  ASSERT_EQ(many[3].size(), 200u);
  for (std::size_t k = 0; k < 100; ++k) EXPECT_EQ(many[3][k], few[3][k]);
  ASSERT_EQ(run.bench.tunica({"run", "experiment.json", "-o", "anew", "--posterior=800"}).code, 0);
  EXPECT_TRUE(run.bench.text("anew/" + run.file.substr(4)) == run.bench.text(run.file));
}

// Draws of another seed or with a discrepancy are others.
TEST(PosteriorOfARun, KeepsNoStepsOfAnotherQuestion) {
  KilledRun run;
  ASSERT_EQ(run.bench.tunica({"run", "experiment.json", "-o", "out", "--resume", "--discrepancy"}).code, 0);
  ASSERT_EQ(run.bench.tunica({"run", "experiment.json", "-o", "anew", "--discrepancy"}).code, 0);
  EXPECT_TRUE(run.bench.text("anew/" + run.file.substr(4)) == run.bench.text(run.file));
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
