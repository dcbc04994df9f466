// SPDX-License-Identifier: Apache-2.0
#include "execution/runner.hpp"

#include <csignal>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "execution/checkpoint.hpp"
#include "execution/folder.hpp"
#include "execution/interrupt.hpp"
#include "execution/laboratory.hpp"
#include "execution/running.hpp"
#include "tunica/detail/vector_level.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using execution::Execution;
using ::testing::HasSubstr;
using trial::expect_equal;
using trial::Many;
using trial::rows;
using trial::run;

TEST(Runner, GivesTheSameRowsForAnyNumberOfThreads) {
  const Many laboratory;
  const trial::Folder one, two;
  const auto first = run(laboratory, one.path(), 1), second = run(laboratory, two.path(), 2);
  expect_equal(first, second);
  EXPECT_EQ(rows(one.path()), rows(two.path()));
  EXPECT_FALSE(first.interrupted);
  EXPECT_EQ(first.runs[0].realisations[0].tally.evaluations, 500u);
  EXPECT_NE(first.runs[0].realisations[0].best.parameters, first.runs[0].realisations[1].best.parameters);
}

// Cuts the journal at every possible kind of place; the resumed run must not differ from the one that was left alone.
TEST(Runner, ResumesToTheIdenticalResult) {
  const Many laboratory;
  const trial::Folder whole;
  const auto expected = run(laboratory, whole.path());
  const std::string journal = trial::text_of(whole.path() / "evaluations.csv");
  auto checkpoint = nlohmann::json::parse(trial::text_of(whole.path() / "checkpoint.json"));
  // With all of them marked as finished too: without their rows, as after a loss of power, they must not count.
  const std::string all_finished = checkpoint.dump();
  checkpoint["finished"] = nlohmann::json::array();
  for (const std::size_t cut :
       {std::size_t{0}, std::size_t{40}, journal.size() / 7, journal.size() / 2, journal.size() - 1}) {
    for (const std::string& finished : {checkpoint.dump(), all_finished}) {
      const trial::Folder part;
      part.write("evaluations.csv", journal.substr(0, cut));
      part.write("checkpoint.json", finished);
      part.write("input.json", laboratory.bench.experiment.input_json);
      expect_equal(run(laboratory, part.path(), 2, true), expected);
      EXPECT_EQ(rows(part.path()), rows(whole.path())) << "cut at byte " << cut << " of " << journal.size();
    }
  }
}

TEST(Runner, DoesNotRunFinishedRealisationsAgain) {
  const Many laboratory;
  const trial::Folder folder;
  const auto expected = run(laboratory, folder.path());
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("evaluated again"); });
  expect_equal(run(laboratory, folder.path(), 1, true), expected);
}

TEST(Runner, RefusesToResumeWhatHasChanged) {
  Many laboratory;
  const trial::Folder folder;
  EXPECT_THAT(trial::message_of<InputError>([&] { run(laboratory, folder.path(), 1, true); }),
              HasSubstr("there is no checkpoint.json, so no run to resume"));
  run(laboratory, folder.path());
  laboratory.bench.experiment.input_json = "{\"name\": \"fake\", \"stop\": {\"max_evaluations\": 200}}";
  laboratory.bench.experiment.seed = 99;
  const auto message = trial::message_of<InputError>([&] { run(laboratory, folder.path(), 1, true); });
  EXPECT_THAT(message, HasSubstr("/stop/max_evaluations (was 100, is 200)"));
  EXPECT_THAT(message, HasSubstr("the seed changed (was 1, is 99)"));
  EXPECT_THAT(message, HasSubstr("Put it back as it was, or start anew"));
}

TEST(Runner, RefusesToGoOnWithOtherVectorInstructions) {
  const Many laboratory;
  const trial::Folder whole, part, analysed;
  const auto expected = run(laboratory, whole.path());
  auto checkpoint = execution::read_checkpoint(whole.path());
  const std::string here = checkpoint.facts.vector_level;
  EXPECT_EQ(here, detail::name(detail::vector_level()));
  EXPECT_EQ(execution::vector_level_of(whole.path()), here);
  EXPECT_EQ(execution::vector_level_of(part.path()), "");
  const auto put = [&](const trial::Folder& folder) {
    folder.write("evaluations.csv", trial::text_of(whole.path() / "evaluations.csv"));
    folder.write("input.json", laboratory.bench.experiment.input_json);
    execution::write_checkpoint(folder.path(), checkpoint);
  };
  checkpoint.facts.vector_level = "avx1024";
  put(analysed);  // every search is finished: nothing is evaluated that could differ
  expect_equal(run(laboratory, analysed.path(), 1, true), expected);
  checkpoint.finished.pop_back();
  put(part);
  EXPECT_THAT(trial::message_of<InputError>([&] { run(laboratory, part.path(), 1, true); }),
              AllOf(HasSubstr("with the vector instructions '" + here +
                              "', because its searches were begun with "
                              "'avx1024'"),
                    HasSubstr("This processor does not have them"), HasSubstr("TUNICA_VECTOR_LEVEL=" + here)));
  if (detail::best_vector_level() == detail::VectorLevel::baseline) return;
  checkpoint.facts.vector_level = here == "baseline" ? "avx2" : "baseline";
  put(part);
  EXPECT_THAT(trial::message_of<InputError>([&] { run(laboratory, part.path(), 1, true); }),
              HasSubstr("Set TUNICA_VECTOR_LEVEL=" + checkpoint.facts.vector_level));
}

TEST(Runner, RefusesToResumeWithOtherData) {
  const Many laboratory;
  const trial::Folder folder;
  run(laboratory, folder.path());
  execution::AppendFile(laboratory.bench.experiment.tests.front().data.files.front()).append("1.5,9,90\n");
  EXPECT_THAT(trial::message_of<InputError>([&] { run(laboratory, folder.path(), 1, true); }),
              HasSubstr("the data curve.csv changed"));
}

TEST(Runner, SavesOnCtrlCAndGoesOnFromThere) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk", 20000, 3);
  const trial::Folder whole, cut;
  const auto expected = run(laboratory, whole.path());
  {
    const execution::InterruptWatch watch;
    std::atomic<int> calls = 0;
    fakes::set_behaviour([&](double, std::span<double>, Status&) {
      if (++calls == 25000) std::raise(SIGINT);
    });
    const auto interrupted = run(laboratory, cut.path());
    EXPECT_TRUE(interrupted.interrupted);
    EXPECT_TRUE(interrupted.runs[0].realisations[0].finished);
    EXPECT_FALSE(interrupted.runs[0].realisations[1].finished);
  }
  fakes::set_behaviour({});
  const execution::InterruptWatch watch;
  const auto resumed = run(laboratory, cut.path(), 1, true);
  EXPECT_FALSE(resumed.interrupted);
  expect_equal(resumed, expected);
  EXPECT_EQ(rows(cut.path()), rows(whole.path()));
}

TEST(Runner, SharesTheBudgetBetweenStagesAndStartsFromTheBest) {
  trial::Laboratory laboratory;
  auto& optimizers = laboratory.bench.experiment.optimizers;
  optimizers.push_back(fakes::optimizer_entry("stages"));
  optimizers.back().name = "hybrid";
  experiment::Stop own;
  own.max_evaluations = 40;
  optimizers.back().stages = {{"walk", own}, {"compass", {}}};
  laboratory.add_run("hybrid", 200);
  laboratory.add_run("walk", 40);
  const trial::Folder folder;
  const auto execution = run(laboratory, folder.path());
  const auto& hybrid = execution.runs[0].realisations[0];
  EXPECT_LE(hybrid.tally.evaluations, 200u);
  EXPECT_GT(hybrid.tally.evaluations, 41u);
  EXPECT_GE(hybrid.best.index, 40u);
  // The second stage begins at the best point of the first: evaluation 41 repeats it.
  const auto plan = laboratory.plan();
  const auto table = plan.table();
  std::istringstream stream(trial::text_of(folder.path() / "evaluations.csv"));
  std::string line;
  std::getline(stream, line);
  execution::EvaluationTable::Row row;
  search::JournalEntry entry;
  double best = 1e300, first_of_second = 0;
  for (int id = 1; id <= 41; ++id) {
    std::getline(stream, line);
    table.parse(line, row);
    table.values(row, entry);
    if (id <= 40) best = std::min(best, entry.objective);
    first_of_second = entry.objective;
  }
  EXPECT_NEAR(first_of_second, best, 1e-9 * best);
}

TEST(Runner, TracesEveryImprovementUpToTheBest) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk", 500);
  const trial::Folder folder;
  const auto execution = run(laboratory, folder.path());
  const auto& result = execution.runs[0].realisations[0];
  ASSERT_GT(result.trace.size(), 2u);
  for (std::size_t k = 1; k < result.trace.size(); ++k) {
    EXPECT_GT(result.trace[k].evaluations, result.trace[k - 1].evaluations);
    EXPECT_LT(result.trace[k].objective, result.trace[k - 1].objective);
  }
  EXPECT_EQ(result.trace.back().evaluations, result.best.index + 1);
  EXPECT_EQ(result.trace.back().objective, result.best.objective);
}

TEST(Runner, GoesOnWithTheOthersWhenAnOptimiserThrows) {
  trial::Laboratory laboratory;
  laboratory.add_run("thrower");
  laboratory.add_run("compass");
  const trial::Folder folder;
  const auto ended = run(laboratory, folder.path());
  const auto& broken = ended.runs[0].realisations[0];
  EXPECT_TRUE(broken.finished);
  EXPECT_FALSE(broken.converged);
  EXPECT_EQ(broken.stopped_by, search::StopReason::optimizer_failure);
  EXPECT_THAT(broken.reason, HasSubstr("plugin 'fakes 1' failed: the population is too small"));
  EXPECT_EQ(broken.tally.evaluations, 1u);
  EXPECT_TRUE(broken.best.found());
  EXPECT_GT(ended.runs[1].realisations[0].tally.evaluations, 50u);
  expect_equal(run(laboratory, folder.path(), 1, true), ended);
}

TEST(Runner, BeginsEveryRealisationElsewhereWhereTheStartIsRandom) {
  trial::Laboratory laboratory;
  laboratory.add_run("compass", 100, 2);
  laboratory.add_run("compass", 100, 2).random_start = true;
  laboratory.add_run("residual", 100, 1).random_start = true;
  const trial::Folder folder;
  const auto ended = run(laboratory, folder.path());
  const auto first = [&](std::size_t run, std::size_t realisation) {
    return ended.runs[run].realisations[realisation].trace.at(0).objective;
  };
  EXPECT_EQ(first(0, 0), first(0, 1));
  EXPECT_NE(first(1, 0), first(1, 1));
  EXPECT_NE(first(1, 0), first(0, 0));
  expect_equal(run(laboratory, folder.path(), 2, true), ended);
}

TEST(Runner, ReportsTheFirstReasonWhenNothingSucceeds) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk", 5000);
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("row 2: no root"); });
  const trial::Folder folder;
  const auto execution = run(laboratory, folder.path());
  const auto& result = execution.runs[0].realisations[0];
  EXPECT_TRUE(result.best.parameters.empty());
  EXPECT_EQ(result.tally.failures, result.tally.evaluations);
  EXPECT_LT(result.tally.evaluations, 5000u);
  EXPECT_THAT(result.tally.first_failure, HasSubstr("row 2: no root"));
  EXPECT_THAT(trial::text_of(folder.path() / "run.log"), HasSubstr("row 2: no root"));
}
