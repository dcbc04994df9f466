// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include <gmock/gmock.h>

#include "cluster/command.hpp"
#include "cluster/estimate.hpp"
#include "cluster/overview.hpp"
#include "cluster/submission.hpp"
#include "execution/folder.hpp"
#include "text/shell.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using namespace tunica::cluster;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

/// Ten specimens a second, one of which may take half a second.
constexpr Pilot quick{3, 0.1, 0.5, 1.0, 100 << 20};

slurm::Task task(const char* job, std::size_t part, const char* state) {
  return {job, part, "array", state, "", "n1", slurm::phase_of(state)};
}

}  // namespace

TEST(Estimate, MakesShardsThatTakeTwentyMinutes) {
  EXPECT_EQ(shards_for(quick, 100, 1, 1000), 1);      // 10 s
  EXPECT_EQ(shards_for(quick, 120000, 1, 1000), 10);  // 12000 s
  EXPECT_EQ(shards_for(quick, 120000, 4, 1000), 3);   // the same work by four threads
  EXPECT_EQ(shards_for(quick, 1000000000, 1, 1000), 1000);
  const Pilot slow{3, 3600, 3600, 1, 0};
  EXPECT_EQ(shards_for(slow, 7, 1, 1000), 7);  // at least a specimen each
}

TEST(Estimate, LimitsHaveTheStatedMargins) {
  // 2 × (1 s + 100 × 0.5 s) + 120 s = 222 s; 1.5 × 100 MiB = 150, in steps of 64
  const Limits limits = shard_limits(quick, 100, 1);
  EXPECT_EQ(limits.minutes, 4);
  EXPECT_EQ(limits.mebibytes, 192);
  // Two threads halve the rounds: 2 × (1 s + 50 × 0.5 s) + 120 s = 172 s
  EXPECT_EQ(shard_limits(quick, 100, 2).minutes, 3);
  EXPECT_DOUBLE_EQ(shard_seconds(quick, 100, 1), 11);
}

TEST(Estimate, GivesTheMergeWhatGrowsWithTheSpecimens) {
  // 1800 s + 20 × 3 s + 4 × 1000 × 0.06 s = 2100 s; 1 GiB + 1000 × 256 KiB = 1274 MiB, in steps of 64
  const Limits limits = merge_limits(1000, 3, 0.06);
  EXPECT_EQ(limits.minutes, 35);
  EXPECT_EQ(limits.mebibytes, 1280);
}

TEST(ArrayText, JoinsNeighbours) {
  const auto text_of = [](std::initializer_list<std::size_t> positions) {
    ArrayText text;
    for (const std::size_t position : positions) text.add(position);
    return text.text();
  };
  EXPECT_EQ(text_of({}), "");
  EXPECT_EQ(text_of({1, 2, 3}), "1-3");
  EXPECT_EQ(text_of({2, 4, 5, 9, 10, 11, 20}), "2,4-5,9-11,20");
}

TEST(Command, PassesWordsWithoutAShell) {
  const std::string awkward = "it's; $HOME `ls` \\ \"x\"\n%a";
  const Ended ended = run_command({"printf", "%s|%s", awkward, ""});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.out, awkward + "|");
  EXPECT_GT(ended.peak_bytes, 0);
}

TEST(Command, QuotesWordsSoThatAShellReadsThemBack) {
  const std::string awkward = "it's; $HOME `ls` \\ \"x\"\n%a";
  EXPECT_EQ(run_command({"sh", "-c", "printf %s " + text::quoted(awkward)}).out, awkward);
  EXPECT_EQ(run_command({"sh", "-c", "printf '%s,' " + text::quoted(std::vector<std::string>{"", "a b", "~"})}).out,
            ",a b,~,");
  EXPECT_EQ(text::quoted("/plain/path-1.json"), "/plain/path-1.json");
}

TEST(Command, ReadsBothStreamsHoweverLong) {
  const Ended ended = run_command({"sh", "-c", "head -c 1000000 /dev/zero; head -c 1000000 /dev/zero >&2; exit 3"});
  EXPECT_EQ(ended.out.size(), 1000000);
  EXPECT_EQ(ended.err.size(), 1000000);
  EXPECT_EQ(ended.code, 3);
}

TEST(Command, SaysHowAProgramEnded) {
  EXPECT_EQ(run_command({"sh", "-c", "kill -9 $$"}).code, 137);
  const Ended none = run_command({"no-such-program-of-slurm"});
  EXPECT_EQ(none.code, 127);
  EXPECT_THAT(none.err, HasSubstr("no-such-program-of-slurm could not be started: No such file"));
  EXPECT_EQ(last_line("a\nb c\n\n  \n"), "b c");
  EXPECT_EQ(last_line(""), "");
}

TEST(Slurm, ReadsItsQueue) {
  const auto tasks = slurm::tasks_of(
      "12|3|array|RUNNING|None|n[1-2]\n"
      "12|N/A|array-merge|PENDING|Dependency|\n"
      "slurm_load_jobs error: words of another kind\n"
      "13|4|array|TIMEOUT|TimeLimit|n1\n");
  ASSERT_EQ(tasks.size(), 3);
  EXPECT_EQ(tasks[0].part, 3);
  EXPECT_EQ(tasks[0].phase, slurm::Phase::running);
  EXPECT_EQ(tasks[0].reason, "");
  EXPECT_EQ(tasks[0].nodes, "n[1-2]");
  EXPECT_FALSE(tasks[1].part);
  EXPECT_TRUE(tasks[1].alive());
  EXPECT_EQ(tasks[2].phase, slurm::Phase::failed);
  EXPECT_EQ(tasks[2].reason, "TimeLimit");
}

TEST(Slurm, KnowsWhichStatesAreAlive) {
  for (const char* state : {"PENDING", "REQUEUED", "REQUEUE_HOLD", "CONFIGURING"})
    EXPECT_EQ(slurm::phase_of(state), slurm::Phase::waiting) << state;
  for (const char* state : {"RUNNING", "COMPLETING", "SUSPENDED"})
    EXPECT_EQ(slurm::phase_of(state), slurm::Phase::running) << state;
  EXPECT_EQ(slurm::phase_of("COMPLETED"), slurm::Phase::ended);
  for (const char* state : {"FAILED", "TIMEOUT", "NODE_FAIL", "OUT_OF_MEMORY", "CANCELLED by 0", "PREEMPTED"})
    EXPECT_EQ(slurm::phase_of(state), slurm::Phase::failed) << state;
}

TEST(Slurm, OrdersAMergeAfterTheEndOfTheShardsHoweverTheyEnd) {
  const Submission submission{"array", {7, 2, "30", "256M", "31", "1G", "long"}, {}};
  const auto array = slurm::words_of(shards_order(submission, "/a %a b/r", "1-7"));
  EXPECT_EQ(array.front(), "sbatch");
  for (const char* word : {"--requeue", "--array=1-7", "--cpus-per-task=2", "--time=30", "--mem=256M",
                           "--partition=long", "--output=/a %%a b/r/slurm/shard_%a.txt", "--chdir=/a %a b/r"})
    EXPECT_THAT(array, Contains(word));
  EXPECT_EQ(array.back(), "/a %a b/r/slurm/shard.sh");
  const auto merge = slurm::words_of(merge_order(submission, "/r", "12:13"));
  for (const char* word : {"--job-name=array-merge", "--dependency=afterany:12:13", "--time=31", "--mem=1G"})
    EXPECT_THAT(merge, Contains(word));
  EXPECT_THAT(merge, Not(Contains(HasSubstr("--array"))));
  const auto message = trial::message_of<InputError>([&] { slurm::submit(shards_order(submission, "/a\\b", "1-7")); });
  EXPECT_THAT(message, HasSubstr("has a backslash, which sbatch reads as a sign of its own"));
}

TEST(Submission, IsStoredAndReadBack) {
  const trial::Folder folder;
  EXPECT_FALSE(stored_submission(folder.path()));
  std::filesystem::create_directories(queue_folder(folder.path()));
  const Submission submission{"array", {7, 2, "30", "256M", "31", "1G", "long"}, {{"12", "1-7"}, {"13", ""}}};
  store(submission, folder.path());
  const auto read = stored_submission(folder.path());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->name, "array");
  EXPECT_EQ(read->wishes.shards, 7);
  EXPECT_EQ(read->wishes.threads, 2);
  EXPECT_EQ(read->wishes.merge_memory, "1G");
  EXPECT_EQ(read->wishes.partition, "long");
  ASSERT_EQ(read->jobs.size(), 2);
  EXPECT_EQ(read->jobs[0].id + read->jobs[0].array + read->jobs[1].id + read->jobs[1].array, "121-713");
  folder.write("slurm/jobs.json", "{\"jobs\": 3");
  EXPECT_THAT(trial::message_of<InputError>([&] { stored_submission(folder.path()); }),
              HasSubstr("jobs.json: is not what `tunica cohort submit` writes"));
}

TEST(Submission, IsHeldByOneAtATime) {
  const trial::Folder folder;
  {
    const SubmissionLock first(folder.path());
    EXPECT_THAT(trial::message_of<InputError>([&] { const SubmissionLock second(folder.path()); }),
                HasSubstr("another tunica is submitting this cohort"));
  }
  EXPECT_NO_THROW(const SubmissionLock third(folder.path()));
}

TEST(Submission, NamesItsJobsByTheirFolder) {
  EXPECT_THAT(job_name("a study, of 3", "/r"), ::testing::MatchesRegex("tunica-a-study--of-3-[0-9a-f]{8}"));
  EXPECT_NE(job_name("study", "/r/1"), job_name("study", "/r/2"));
}

TEST(Overview, NamesJobsThatWaitForAPerson) {
  const trial::Folder folder;
  const auto tasks = slurm::tasks_of(
      "9|1|array|PENDING|launch failed requeued held|\n"
      "9|2|array|PENDING|Resources|\n"
      "10|N/A|array-merge|PENDING|JobHeldUser|\n");
  const Overview view =
      overview({"array", {2, 1, "30", "256M", "31", "1G", ""}, {{"9", "1-2"}, {"10", ""}}}, {}, tasks, folder.path());
  ASSERT_EQ(view.held.size(), 2);
  const std::string words = in_words(view, {});
  EXPECT_THAT(words, HasSubstr("scontrol release 9_1\n"));
  EXPECT_THAT(words, HasSubstr("scontrol release 10\n"));
}

TEST(Overview, AsksRecordsFirstAndThenTheQueue) {
  const trial::Folder folder;
  std::filesystem::create_directories(queue_folder(folder.path()));
  folder.write("slurm/shard_2.txt", "50 %  5 of 10 specimens\nerror: no space\n");
  const Submission submission{"array", {5, 1, "30", "256M", "31", "1G", ""}, {{"9", "1-5"}, {"10", ""}}};
  std::vector<cohort::ShareProgress> progress;
  for (std::size_t part = 1; part <= 5; ++part) progress.push_back({{part, 5}, 10, part == 1 ? 0u : part});
  const std::vector<slurm::Task> tasks{task("9", 1, "FAILED"),   task("9", 2, "FAILED"),  task("9", 3, "FAILED"),
                                       task("10", 3, "RUNNING"), task("9", 4, "PENDING"), task("10", 5, "FAILED"),
                                       task("9", 5, "TIMEOUT")};
  const Overview view = overview(submission, progress, tasks, folder.path());
  std::vector<Standing> standings;
  for (const auto& shard : view.shards) standings.push_back(shard.standing);
  EXPECT_THAT(standings,
              ElementsAre(Standing::done, Standing::stopped, Standing::running, Standing::waiting, Standing::stopped));
  EXPECT_EQ(view.shards[1].last_words, "error: no space");
  EXPECT_EQ(view.shards[2].job, "10") << "the one that is alive";
  EXPECT_EQ(view.shards[4].job, "10") << "the younger one, by number and not by spelling";
  EXPECT_EQ(view.missing, 14);
  EXPECT_TRUE(view.stuck());
}
