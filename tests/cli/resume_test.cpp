// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <signal.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::HasSubstr;

namespace {

/// Long enough to be killed in the middle: three searches of 60000 evaluations.
struct LongBench : trial::Bench {
  LongBench() {
    experiment["stop"]["max_evaluations"] = 60000;
    save();
  }
  [[nodiscard]] std::vector<std::string> run(const std::string& output) const {
    return trial::tunica_command({"run", "experiment.json", "-o", output, "-j", "2"});
  }
  /// Waits until the journal has so many bytes; false when the process came to its end before.
  [[nodiscard]] bool wait_for(const std::string& output, std::uintmax_t bytes) const {
    for (int attempt = 0; attempt < 3000; ++attempt) {
      std::error_code none;
      if (std::filesystem::exists(path(output + "/result.json"), none)) return false;
      const auto size = std::filesystem::file_size(path(output + "/evaluations.csv"), none);
      if (!none && size >= bytes) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }
  void expect_equal(const std::string& a, const std::string& b) const {
    EXPECT_EQ(trial::without_times(result(a)), trial::without_times(result(b)));
    EXPECT_TRUE(trial::without_times(text(a + "/evaluations.csv")) ==
                trial::without_times(text(b + "/evaluations.csv")));
    EXPECT_FALSE(std::filesystem::exists(path(b + "/parts")));
  }
};

}  // namespace

TEST(Resume, AfterKillsGivesTheIdenticalResult) {
  const LongBench bench;
  ASSERT_EQ(trial::Process(bench.run("whole"), bench.folder.path()).wait().code, 0);
  {
    trial::Process process(bench.run("killed"), bench.folder.path());
    ASSERT_TRUE(bench.wait_for("killed", 300000));
    process.signal(SIGKILL);
    EXPECT_EQ(process.wait().code, 128 + SIGKILL);
  }
  auto again = bench.run("killed");
  again.push_back("--resume");
  {
    trial::Process process(again, bench.folder.path());
    const auto size = std::filesystem::file_size(bench.path("killed/evaluations.csv"));
    ASSERT_TRUE(bench.wait_for("killed", size + 300000));
    process.signal(SIGKILL);
    EXPECT_EQ(process.wait().code, 128 + SIGKILL);
  }
  const auto ended = trial::Process(again, bench.folder.path()).wait();
  ASSERT_EQ(ended.code, 0) << ended.err;
  bench.expect_equal("whole", "killed");
}

// As on a machine with wider vectors than the one before: the run goes on with those that it was begun with.
TEST(Resume, KeepsTheVectorInstructionsThatTheRunWasBegunWith) {
  const LongBench bench;
  const auto on_baseline = [&](const std::string& output) {
    auto words = bench.run(output);
    words.insert(words.begin(), {"/usr/bin/env", "TUNICA_VECTOR_LEVEL=baseline"});
    return words;
  };
  ASSERT_EQ(trial::Process(on_baseline("whole"), bench.folder.path()).wait().code, 0);
  {
    trial::Process process(on_baseline("killed"), bench.folder.path());
    ASSERT_TRUE(bench.wait_for("killed", 300000));
    process.signal(SIGINT);
    EXPECT_EQ(process.wait().code, 130);
  }
  auto again = bench.run("killed");
  again.push_back("--resume");
  const auto ended = trial::Process(again, bench.folder.path()).wait();
  ASSERT_EQ(ended.code, 0) << ended.err;
  bench.expect_equal("whole", "killed");
  EXPECT_EQ(bench.result("killed")["provenance"]["vector_level"], "baseline");
}

TEST(Resume, AfterCtrlCGivesTheIdenticalResult) {
  const LongBench bench;
  ASSERT_EQ(trial::Process(bench.run("whole"), bench.folder.path()).wait().code, 0);
  trial::Process process(bench.run("cut"), bench.folder.path());
  ASSERT_TRUE(bench.wait_for("cut", 300000));
  process.signal(SIGINT);
  const auto interrupted = process.wait();
  EXPECT_EQ(interrupted.code, 130);
  EXPECT_EQ(interrupted.out, "");
  EXPECT_THAT(interrupted.err,
              HasSubstr("everything so far is saved. Go on with\n  tunica run experiment.json -o cut --resume"));
  EXPECT_FALSE(std::filesystem::exists(bench.path("cut/result.json")));
  auto again = bench.run("cut");
  again.push_back("--resume");
  const auto ended = trial::Process(again, bench.folder.path()).wait();
  ASSERT_EQ(ended.code, 0) << ended.err;
  bench.expect_equal("whole", "cut");
}

// The first evaluation of this run takes minutes. It is not in the journal, so it was not waited for.
TEST(Resume, AfterCtrlCInsideOneLongSimulation) {
  trial::Bench bench;
  std::string rows = "pressure [kPa],outer [mm]\n";
  for (int k = 1; k <= 40; ++k) rows += std::to_string(k) + ",12\n";
  bench.folder.write("tube.csv", rows);
  bench.experiment["tests"] = {
      {"tube",
       {{"type", "fe_pressurisation"},
        {"inner_radius", "3.71 mm"},
        {"thickness", "2.06 mm"},
        {"length", "40 mm"},
        {"axial_stretch", 1.2},
        {"element", "quadrilateral_4"},
        {"elements", {100, 1000}},
        {"time_limit", "600 s"},
        {"data", {{"file", "tube.csv"}, {"columns", {{"pressure", "pressure"}, {"outer_diameter", "outer"}}}}}}}};
  bench.experiment["runs"] = {{{"model", "gho"}, {"optimizer", "es"}}};
  bench.save();
  trial::Process process(trial::tunica_command({"run", "experiment.json", "-o", "out", "-j", "1"}),
                         bench.folder.path());
  for (int attempt = 0; attempt < 3000 && !std::filesystem::exists(bench.path("out/evaluations.csv")); ++attempt)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  process.signal(SIGINT);
  const auto ended = process.wait();
  EXPECT_EQ(ended.code, 130);
  EXPECT_THAT(ended.err, HasSubstr("everything so far is saved. Go on with\n  tunica run experiment.json -o out"));
  EXPECT_FALSE(std::filesystem::exists(bench.path("out/result.json")));
  const std::string written = bench.text("out/evaluations.csv");
  EXPECT_EQ(std::count(written.begin(), written.end(), '\n'), 1) << "the simulation was waited for";
}

TEST(Resume, OfAFinishedRunRepeatsItsResult) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  const auto before = trial::without_times(bench.result("out"));
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out", "--resume"}).code, 0);
  EXPECT_EQ(trial::without_times(bench.result("out")), before);
}

TEST(Resume, OfARunThatWasKilledBeforeItsFirstCheckpointBeginsAgain) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "whole"}).code, 0);
  std::filesystem::create_directories(bench.path("cut/parts"));
  bench.folder.write("cut/input.json", "{");
  bench.folder.write("cut/run.log", "");
  bench.folder.write("cut/checkpoint.json.new-0123456789abcdef", "{");
  const std::string journal = bench.text("whole/evaluations.csv");
  bench.folder.write("cut/evaluations.csv", journal.substr(0, journal.find('\n') + 1));
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "cut", "--resume"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(trial::without_times(bench.result("cut")), trial::without_times(bench.result("whole")));
  // Rows without a checkpoint were paid for: nothing is taken away.
  std::filesystem::remove(bench.path("cut/checkpoint.json"));
  EXPECT_EQ(bench.tunica({"run", "experiment.json", "-o", "cut", "--resume"}).code, 2);
  EXPECT_TRUE(std::filesystem::exists(bench.path("cut/evaluations.csv")));
}

TEST(Resume, SaysWhatIsDamagedAndGivesTheIdenticalResult) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  const auto before = trial::without_times(bench.result("out"));
  std::string journal = bench.text("out/evaluations.csv");
  char& digit = journal[journal.rfind(",ok,") - 1];
  digit = digit == '1' ? '2' : '1';
  bench.folder.write("out/evaluations.csv", journal);
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out", "--resume", "--quiet"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("warning: "));
  EXPECT_THAT(ended.err, HasSubstr("damaged_rows.csv"));
  EXPECT_EQ(trial::without_times(bench.result("out")), before);
}

TEST(Resume, SaysWhatChanged) {
  trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  bench.experiment["stop"]["max_evaluations"] = 700;
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out", "--resume"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("the experiment file changed: /"));
  EXPECT_THAT(ended.err, HasSubstr("max_evaluations (was 600, is 700)"));
  bench.experiment["stop"]["max_evaluations"] = 600;
  bench.folder.write("circ.csv", bench.text("circ.csv") + "1.42,50\n");
  EXPECT_THAT(bench.tunica({"run", "experiment.json", "-o", "out", "--resume"}).err,
              HasSubstr("the data circ.csv changed"));
}

TEST(Resume, NeedsAnInterruptedRun) {
  const trial::Bench bench;
  auto ended = bench.tunica({"run", "experiment.json", "-o", "nowhere", "--resume"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("nowhere: no such folder"));
  ended = bench.tunica({"run", "experiment.json", "--resume"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("there is no run to resume here"));
}

TEST(FullDisk, IsReportedAndTheRunCanGoOn) {
  const LongBench bench;
  auto command = bench.run("out");
  // No file beyond 200 kB for this process: what a full disk looks like to a program. Where a build counts its lines,
  // the counts would be such a file: they go nowhere.
  std::string line = "ulimit -f 200; GCOV_PREFIX=/dev/null";
  for (const auto& word : command) line += " '" + word + "'";
  const auto stopped = trial::Process({"/bin/bash", "-c", line}, bench.folder.path()).wait();
  EXPECT_EQ(stopped.code, 130);
  EXPECT_THAT(stopped.err, HasSubstr("cannot write: "));
  EXPECT_THAT(stopped.err, HasSubstr("--resume"));
  command.push_back("--resume");
  const auto ended = trial::Process(command, bench.folder.path()).wait();
  EXPECT_EQ(ended.code, 0) << ended.err;
}
