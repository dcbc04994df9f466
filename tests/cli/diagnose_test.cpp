// SPDX-License-Identifier: Apache-2.0
// What `tunica diagnose` leaves behind, and what it does not.
#include <chrono>
#include <thread>

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
