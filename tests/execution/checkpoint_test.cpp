// SPDX-License-Identifier: Apache-2.0
#include "execution/checkpoint.hpp"

#include <gmock/gmock.h>

#include "execution/folder.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using execution::Checkpoint;
using ::testing::HasSubstr;

namespace {

std::string refusal(const std::filesystem::path& folder) {
  return trial::message_of<InputError>([&] { execution::read_checkpoint(folder); });
}

}  // namespace

TEST(Checkpoint, ReadsBackWhatItWrote) {
  const trial::Folder folder;
  Checkpoint checkpoint;
  checkpoint.facts = {"abc", "7", {{"a.csv", "x"}}, "es 0.1.0", "9", true, "avx2"};
  execution::RealisationResult result;
  result.realisation = 4;
  result.best = {{0.1, 1.0 / 3, 1e-300}, 66.1, 17};
  result.trace = {{3, 1e300}, {18, 66.1}};
  result.tally = {120, 30, 5, 2, 40, 70, 900, "row 3: \"no\" root", {{"row 3: \"no\" root", 5}}};
  result.converged = true;
  result.reason = "step below tolerance";
  result.stopped_by = search::StopReason::failure_rate;
  result.stop_sentence = "failure rate: too many";
  result.seconds = 1.5;
  checkpoint.finished.emplace_back(3, result);
  execution::write_checkpoint(folder.path(), checkpoint);
  const auto read = execution::read_checkpoint(folder.path());
  EXPECT_EQ(read.facts, checkpoint.facts);
  ASSERT_EQ(read.finished.size(), 1u);
  const auto& [task, back] = read.finished.front();
  EXPECT_EQ(task, 3u);
  EXPECT_TRUE(back.finished);
  EXPECT_EQ(back.realisation, 4u);
  EXPECT_EQ(back.best.parameters, result.best.parameters);
  EXPECT_EQ(back.best.objective, result.best.objective);
  EXPECT_EQ(back.best.index, 17u);
  ASSERT_EQ(back.trace.size(), 2u);
  EXPECT_EQ(back.trace[0].objective, 1e300);
  EXPECT_EQ(back.trace[1].evaluations, 18u);
  EXPECT_EQ(back.tally.evaluations, 120u);
  EXPECT_EQ(back.tally.jacobians, 30u);
  EXPECT_EQ(back.tally.failures, 5u);
  EXPECT_EQ(back.tally.infeasible, 2u);
  EXPECT_EQ(back.tally.ended_early, 40u);
  EXPECT_EQ(back.tally.simulated, 70u);
  EXPECT_EQ(back.tally.guide_evaluations, 900u);
  EXPECT_EQ(back.tally.first_failure, result.tally.first_failure);
  ASSERT_EQ(back.tally.reasons.size(), 1u);
  EXPECT_EQ(back.tally.reasons[0].example, result.tally.first_failure);
  EXPECT_EQ(back.tally.reasons[0].count, 5u);
  EXPECT_TRUE(back.converged);
  EXPECT_EQ(back.reason, result.reason);
  EXPECT_EQ(back.stopped_by, search::StopReason::failure_rate);
  EXPECT_EQ(back.stop_sentence, "failure rate: too many");
  EXPECT_EQ(back.seconds, 1.5);
}

TEST(Checkpoint, SaysWhatIsWrongWithAFile) {
  const trial::Folder folder;
  EXPECT_THAT(refusal(folder.path()), HasSubstr("there is no checkpoint.json, so no run to resume"));
  folder.write("checkpoint.json", "{\"format\": 1,");
  EXPECT_THAT(refusal(folder.path()), HasSubstr("cannot be understood"));
  folder.write("checkpoint.json", "{\"format\": 9, \"facts\": {}, \"finished\": []}");
  EXPECT_THAT(refusal(folder.path()), HasSubstr("format 9, this version of tunica reads 6"));
}

TEST(Checkpoint, NamesEveryChange) {
  const trial::Folder folder;
  folder.write("input.json", R"({"stop": {"max_evaluations": 10}, "name": "a"})");
  const auto message = trial::message_of<InputError>([&] {
    execution::refuse_changes(folder.path(), {"1", "7", {{"a.csv", "x"}, {"c.csv", "y"}}, "es 0.1.0", "9"},
                              {"2", "7", {{"b.csv", "x"}, {"c.csv", "z"}}, "es 0.2.0", "9"},
                              R"({"name": "a", "seed": 3})");
  });
  EXPECT_THAT(message, HasSubstr("/stop"));
  EXPECT_THAT(message, HasSubstr("/seed (was absent, is 3)"));
  EXPECT_THAT(message, HasSubstr("the plugins changed (was es 0.1.0, is es 0.2.0)"));
  EXPECT_THAT(message, HasSubstr("the data b.csv are new"));
  EXPECT_THAT(message, HasSubstr("the data a.csv are gone"));
  EXPECT_THAT(message, HasSubstr("the data c.csv changed (was y, is z)"));
  EXPECT_THAT(message, ::testing::Not(HasSubstr("the seed")));
}

TEST(Checkpoint, LetsAnUnchangedRunThrough) {
  const trial::Folder folder;
  EXPECT_NO_THROW(execution::refuse_changes(folder.path(), {.seed = "1"}, {.seed = "1"}, "{}"));
}
