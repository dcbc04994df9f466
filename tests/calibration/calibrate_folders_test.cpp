// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "calibration/calibrating.hpp"
#include "execution/checkpoint.hpp"
#include "execution/damage.hpp"
#include "execution/interrupt.hpp"
#include "tunica/error.hpp"

namespace tunica {
namespace {

using ::testing::HasSubstr;
using trial::Calibrating;
using trial::found_by;

using Ending = calibration::Outcome::Ending;

/// Waits for something that another thread does, a few seconds at most.
template <class Condition>
bool comes_true(Condition&& condition) {
  for (int wait = 0; wait < 600 && !condition(); ++wait) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return condition();
}

std::string refusal_of(const Calibrating& trial) {
  return fakes::message_of([&] { static_cast<void>(trial.calibrate()); });
}

TEST(CalibrateAgain, GoesOnWhereItWasInterrupted) {
  Calibrating whole, cut;
  for (Calibrating* one : {&whole, &cut}) one->add_run("walk", 400, 2);
  const auto expected = whole.calibrate();
  fakes::set_behaviour([&](double, std::span<double>, Status&) {
    if (++cut.calls == 600) execution::InterruptWatch::interrupt();
  });
  const auto interrupted = cut.calibrate();
  EXPECT_EQ(interrupted.ending, Ending::interrupted);
  EXPECT_EQ(interrupted.directory, cut.folder.path() / "out");
  EXPECT_FALSE(cut.has("result.json"));
  EXPECT_THAT(refusal_of(cut), HasSubstr("is not empty, and results are never overwritten"));
  cut.options.resume = true;
  cut.count_calls();
  const auto resumed = cut.calibrate();
  EXPECT_LT(cut.calls, 400) << "what was evaluated is not evaluated again";
  EXPECT_EQ(resumed.ending, Ending::finished);
  EXPECT_EQ(found_by(resumed), found_by(expected));
}

TEST(CalibrateAgain, BeginsAnewWhereNothingWasEvaluatedYet) {
  Calibrating trial;
  trial.add_run("residual");
  trial.options.resume = true;
  std::filesystem::create_directories(trial.out("parts"));
  trial.folder.write("out/run.log", "of the one before\n");
  trial.folder.write("out/input.json", "{}");
  trial.folder.write("out/input.json.new-01", "{");
  trial.folder.write("out/checkpoint.json.new-02", "{");
  trial.folder.write("out/evaluations.csv", "id,run\n");
  EXPECT_EQ(trial.calibrate().ending, Ending::finished);
  EXPECT_FALSE(trial.has("input.json.new-01")) << "the leftovers are cleared";
  EXPECT_FALSE(trial.has("checkpoint.json.new-02"));
  EXPECT_THAT(trial::text_of(trial.out("run.log")), ::testing::Not(HasSubstr("of the one before\n")));
}

TEST(CalibrateAgain, BeginsAnewWhereTheFolderIsEmptyOrItsTableIs) {
  for (const char* rows : {"", "id,ru"}) {
    Calibrating trial;
    trial.add_run("residual");
    trial.options.resume = true;
    std::filesystem::create_directories(trial.folder.path() / "out");
    if (*rows != 0) trial.folder.write("out/evaluations.csv", rows);
    EXPECT_EQ(trial.calibrate().ending, Ending::finished) << rows;
  }
}

TEST(CalibrateAgain, ClearsNothingThatCostAnEvaluationOrIsNotItsOwn) {
  for (const char* file : {"evaluations.csv", "parts/1.csv", "notes.txt", "result.json", "checkpoint.json.old"}) {
    Calibrating trial;
    trial.add_run("residual");
    trial.options.resume = true;
    std::filesystem::create_directories(trial.out("parts"));
    trial.folder.write("out/input.json", "{}");
    trial.folder.write("out/" + std::string(file), "id,run\n1,m\n");
    EXPECT_THAT(refusal_of(trial), HasSubstr("there is no checkpoint.json, so no run to resume")) << file;
    EXPECT_EQ(trial::text_of(trial.out(file)), "id,run\n1,m\n") << file;
  }
}

TEST(CalibrateAgain, NoticesDamage) {
  Calibrating trial;
  trial.add_run("walk", 80);
  const auto before = trial.calibrate();
  const std::string journal = trial::text_of(trial.out("evaluations.csv"));
  trial.folder.write("out/evaluations.csv", trial::changed(journal, journal.size() / 2));
  std::vector<std::string> noticed;
  trial.options.noticed = [&](const std::string& sentence) { noticed.push_back(sentence); };
  trial.options.resume = true;
  EXPECT_EQ(found_by(trial.calibrate()), found_by(before));
  EXPECT_THAT(noticed, ::testing::Contains(HasSubstr("evaluations.csv")));
}

TEST(CalibrateAgain, NumbersItsOwnFoldersWhereNoneIsNamed) {
  Calibrating trial;
  trial.add_run("residual");
  trial.options.directory.reset();
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(trial.folder.path());
  const auto outcome = trial.calibrate();
  trial.options.resume = true;
  const auto resumed = trial.calibrate();
  std::filesystem::current_path(before);
  EXPECT_EQ(outcome.directory, "results/fake-1");
  EXPECT_EQ(resumed.directory, "results/fake-1") << "the newest";
}

TEST(CalibrateInParts, MergesToTheResultOfTheWhole) {
  Calibrating whole, parts;
  for (Calibrating* one : {&whole, &parts}) one->add_run("walk", 100, 3);
  const auto expected = whole.calibrate();
  for (const std::size_t part : {1u, 2u}) {
    parts.options.share = execution::Share{part, 2};
    parts.count_calls();
    const auto outcome = parts.calibrate();
    EXPECT_EQ(outcome.ending, Ending::part_finished);
    EXPECT_EQ(outcome.directory, parts.out("shards/" + std::to_string(part) + "of2"));
    EXPECT_EQ(parts.calls, part == 1 ? 200 : 100) << "its own realisations only";
    EXPECT_FALSE(parts.has("shards/1of2/result.json"));
    parts.count_calls();
    EXPECT_EQ(parts.calibrate().ending, Ending::part_finished);
    EXPECT_EQ(parts.calls, 0) << "a second time nothing is left to do";
  }
  parts.options.share.reset();
  parts.options.merge = true;
  parts.count_calls();
  const auto merged = parts.calibrate();
  EXPECT_LT(parts.calls, 100) << "nothing is searched again";
  EXPECT_EQ(merged.ending, Ending::finished);
  EXPECT_EQ(merged.directory, parts.folder.path() / "out");
  EXPECT_EQ(found_by(merged), found_by(expected));
  EXPECT_TRUE(parts.has("result.json"));
  EXPECT_EQ(merged.provenance.vector_level, expected.provenance.vector_level);
}

TEST(CalibrateInParts, SaysWithWhichInstructionsThePartsWereSearched) {
  Calibrating trial;
  trial.add_run("walk", 50);
  trial.options.share = execution::Share{1, 1};
  static_cast<void>(trial.calibrate());
  const auto part = trial.out("shards/1of1");
  auto checkpoint = execution::read_checkpoint(part);
  checkpoint.facts.vector_level = "avx1024";
  execution::write_checkpoint(part, checkpoint);
  trial.options.share.reset();
  trial.options.merge = true;
  const auto merged = trial.calibrate();
  EXPECT_EQ(merged.provenance.vector_level, "avx1024");
  EXPECT_EQ(nlohmann::json::parse(trial::text_of(merged.result))["provenance"]["vector_level"], "avx1024");
}

TEST(CalibrateInParts, NoticesDamageInAPart) {
  Calibrating trial;
  trial.add_run("walk", 80);
  trial.options.share = execution::Share{1, 1};
  static_cast<void>(trial.calibrate());
  const std::string journal = trial::text_of(trial.out("shards/1of1/evaluations.csv"));
  trial.folder.write("out/shards/1of1/evaluations.csv", trial::changed(journal, journal.size() / 2));
  std::vector<std::string> noticed;
  trial.options.noticed = [&](const std::string& sentence) { noticed.push_back(sentence); };
  trial.options.share.reset();
  trial.options.merge = true;
  static_cast<void>(trial.calibrate());
  EXPECT_THAT(noticed, ::testing::Contains(HasSubstr("shards/1of1")));
}

TEST(CalibrateInParts, BeginsAPartAnewThatWasKilledBeforeItSaved) {
  Calibrating trial;
  trial.add_run("walk", 50);
  trial.options.share = execution::Share{1, 1};
  std::filesystem::create_directories(trial.out("shards/1of1"));
  trial.folder.write("out/shards/1of1/evaluations.csv", "id,run\n1,m\n");
  trial.folder.write("out/shards/1of1/run.log", "of the one before\n");
  EXPECT_EQ(trial.calibrate().ending, Ending::part_finished);
  EXPECT_THAT(trial::text_of(trial.out("shards/1of1/run.log")), ::testing::Not(HasSubstr("of the one before\n")));
}

TEST(CalibrateInParts, NeedsAFolderThatIsForParts) {
  Calibrating trial;
  trial.add_run("residual");
  static_cast<void>(trial.calibrate());
  trial.options.share = execution::Share{1, 2};
  EXPECT_THAT(refusal_of(trial), HasSubstr("holds a run that is not in parts"));
  EXPECT_FALSE(trial.has("shards"));
  trial.options.directory.reset();
  EXPECT_THAT(refusal_of(trial), HasSubstr("parts of a run need a folder"));
  trial.options.share.reset();
  trial.options.merge = true;
  EXPECT_THAT(refusal_of(trial), HasSubstr("parts of a run need a folder"));
  trial.options.directory = trial.folder.path() / "empty";
  EXPECT_THAT(refusal_of(trial), HasSubstr("no such folder"));
  trial.folder.write("results", "a file, so that no folder can be made");
  trial.options.merge = false;
  trial.options.share = execution::Share{1, 2};
  trial.options.directory = trial.folder.path() / "results";
  EXPECT_THAT(refusal_of(trial), HasSubstr("results"));
}

TEST(CalibrateThreads, SearchSideBySide) {
  Calibrating trial;
  trial.add_run("walk", 16, 2);
  trial.options.threads = 2;
  std::mutex mutex;
  std::set<std::thread::id> seen;
  const auto count = [&] {
    const std::lock_guard lock(mutex);
    return seen.size();
  };
  bool first = true;
  fakes::set_behaviour([&](double, std::span<double>, Status&) {
    {
      const std::lock_guard lock(mutex);
      seen.insert(std::this_thread::get_id());
      if (!std::exchange(first, false)) return;
    }
    static_cast<void>(comes_true([&] { return count() > 1; }));
  });
  static_cast<void>(trial.calibrate());
  EXPECT_GE(count(), 2u) << "while one search waits, the other one begins";
}

TEST(CalibrateThreads, SayHowFarTheSearchIs) {
  Calibrating trial;
  trial.add_run("walk", 16);
  std::atomic<bool> told = false;
  std::string line;
  trial.options.progress = execution::Progress::Style::bar;
  trial.options.told = [&](double share, const std::string& text) {
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
    if (!told) line = text;
    told = true;
  };
  fakes::set_behaviour(
      [&](double, std::span<double>, Status&) { static_cast<void>(comes_true([&] { return told.load(); })); });
  ::testing::internal::CaptureStderr();
  static_cast<void>(trial.calibrate());
  const std::string shown = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(line, HasSubstr("0/1 searches"));
  EXPECT_THAT(shown, HasSubstr("\r")) << "a line that is drawn anew";
}

TEST(CalibrateThreads, LeaveWhatDoesNotStop) {
  Calibrating trial;
  trial.add_run("walk", 16);
  std::atomic<bool> left = false;
  std::filesystem::path where;
  trial.options.abandon = [&](const std::filesystem::path& directory) {
    where = directory;
    left = true;
  };
  fakes::set_behaviour([&](double, std::span<double>, Status&) {
    execution::InterruptWatch::interrupt();
    static_cast<void>(comes_true([&] { return left.load(); }));
  });
  EXPECT_EQ(trial.calibrate().ending, Ending::interrupted);
  EXPECT_TRUE(left);
  EXPECT_EQ(where, trial.folder.path() / "out");
}

TEST(CalibrateOnAFullDisk, SaysWhichFileCouldNotBeWritten) {
  Calibrating trial;
  trial.add_run("walk", 400);
  {
    std::optional<trial::NoLargerFile> full;
    trial.options.started = [&](const auto&) { full.emplace(4000); };
    const auto outcome = trial.calibrate();
    EXPECT_EQ(outcome.ending, Ending::write_failure) << "of the searches";
    EXPECT_THAT(outcome.write_failure, HasSubstr("evaluations.csv"));
    EXPECT_FALSE(trial.has("result.json"));
  }
  trial.options.started = {};
  trial.options.resume = true;
  EXPECT_EQ(trial.calibrate().ending, Ending::finished) << "and goes on once there is room";
}

TEST(CalibrateOnAFullDisk, SaysThatAResultCouldNotBeWritten) {
  Calibrating trial;
  trial.add_run("residual");
  trial.options.started = [&](const auto&) {
    std::filesystem::create_directories(trial.out("result.json/in the way"));
  };
  const auto outcome = trial.calibrate();
  EXPECT_EQ(outcome.ending, Ending::write_failure);
  EXPECT_THAT(outcome.write_failure, HasSubstr("result.json"));
}

}  // namespace
}  // namespace tunica
