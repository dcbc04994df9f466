// SPDX-License-Identifier: Apache-2.0
#include "comparison/success.hpp"

#include <gmock/gmock.h>

#include "comparison/performance.hpp"
#include "comparison/study_tables.hpp"
#include "execution/laboratory.hpp"

using namespace tunica;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

namespace {

execution::RealisationResult ended_search(std::uint64_t number, std::vector<execution::Improvement> trace,
                                          std::uint64_t evaluations) {
  execution::RealisationResult result;
  result.realisation = number;
  result.trace = std::move(trace);
  if (!result.trace.empty()) {
    result.best.parameters = {2, 1, 3};
    result.best.objective = result.trace.back().objective;
    result.best.index = result.trace.back().evaluations - 1;
  }
  result.tally.evaluations = evaluations;
  result.seconds = 0.25;
  return result;
}

/// Two optimizers on one problem: the first reaches the best known objective 1 in three of four realisations, the
/// second in its only one.
struct Study {
  Study() {
    laboratory.add_run("walk", 100, 4);
    laboratory.add_run("compass", 100);
    plan.emplace(laboratory.plan());
    results.resize(2);
    results[0].realisations = {ended_search(1, {{1, 9}, {40, 1.0005}, {60, 1}}, 100),
                               ended_search(2, {{3, 5}, {80, 1}}, 100), ended_search(3, {{10, 4}, {90, 2}}, 100),
                               ended_search(4, {{20, 1.0002}}, 70)};
    results[1].realisations = {ended_search(1, {{5, 7}, {30, 1}}, 30)};
    summary = comparison::summarise(*plan, results, {});
  }
  trial::Laboratory laboratory;
  std::optional<execution::Plan> plan;
  std::vector<execution::RunResult> results;
  comparison::Summary summary;
};

}  // namespace

TEST(Success, IsCountedFromTheFirstEvaluationAtTheThreshold) {
  const auto realisation = ended_search(1, {{1, 9}, {40, 1.0005}, {60, 1}}, 100);
  EXPECT_EQ(comparison::evaluations_to(realisation, 9), 1u);
  EXPECT_EQ(comparison::evaluations_to(realisation, 8.9), 40u);
  EXPECT_EQ(comparison::evaluations_to(realisation, 1), 60u);
  EXPECT_FALSE(comparison::evaluations_to(realisation, 0.99));
  EXPECT_FALSE(comparison::evaluations_to(ended_search(1, {}, 100), 5));
}

TEST(Success, GivesTheExpectedRunningTimeOfAugerAndHansen) {
  const Study study;
  const auto& walk = study.summary.runs[0];
  EXPECT_NEAR(walk.threshold, 1.001, 1e-9);
  EXPECT_EQ(walk.successes, 3u);
  EXPECT_DOUBLE_EQ(*walk.expected_running_time, (40 + 80 + 100 + 20) / 3.0);
  EXPECT_DOUBLE_EQ(walk.evaluations_to_target.box->median, 40);
  EXPECT_DOUBLE_EQ(*study.summary.runs[1].expected_running_time, 30);
}

TEST(Success, WithoutAnyHasNoExpectedRunningTime) {
  Study study;
  study.laboratory.bench.experiment.runs[0].stop.target = 1e-9;
  const auto summary = comparison::summarise(*study.plan, study.results, {});
  EXPECT_EQ(summary.runs[0].successes, 0u);
  EXPECT_FALSE(summary.runs[0].expected_running_time);
  EXPECT_EQ(summary.runs[0].success_ci95.first, 0);
  EXPECT_EQ(summary.runs[1].successes, 1u) << "the other run has no target of its own";
}

TEST(Profiles, CountShareSolvedOverCostRelativeToTheBestOptimizer) {
  const Study study;
  const auto made = comparison::profiles(*study.plan, study.results, study.summary.runs);
  ASSERT_EQ(made.performance.size(), 2u);
  EXPECT_EQ(made.performance[0].optimizer, "walk");
  EXPECT_EQ(made.performance[0].problems, 1u);
  // The least expected running time is 30, of compass; walk takes 40, 80, never and 20.
  EXPECT_THAT(made.performance[0].steps, ElementsAre(Pair(1, 0.25), Pair(40 / 30.0, 0.5), Pair(80 / 30.0, 0.75)));
  EXPECT_THAT(made.performance[1].steps, ElementsAre(Pair(1, 1)));
  // Three parameters: one unit is four evaluations.
  EXPECT_THAT(made.data[0].steps, ElementsAre(Pair(5, 0.25), Pair(10, 0.5), Pair(20, 0.75)));
}

TEST(StudyTables, HaveOneRowARunWhateverBecameOfIt) {
  Study study;
  study.results[1].realisations = {ended_search(1, {}, 30)};
  study.results[1].realisations[0].tally.first_failure = "row 1: no root, none";
  study.results[1].realisations[0].tally.failures = 30;
  const auto summary = comparison::summarise(*study.plan, study.results, {});
  const auto text = comparison::ranking_csv(*study.plan, summary);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  EXPECT_THAT(text, HasSubstr("\n1,m/walk,m,walk,curve,least_squares,,ok,,1,"));
  EXPECT_THAT(text, HasSubstr("\n,m/compass,m,compass,curve,least_squares,,failed,\"row 1: no root, none\",,"));
}

TEST(StudyTables, ThinTracesOnlyBetweenTheirEnds) {
  const Study study;
  const auto text = comparison::convergence_csv(study.results, study.summary);
  EXPECT_THAT(text, HasSubstr("\nm/walk,1,1,9\nm/walk,1,40,1.0005\nm/walk,1,60,1\nm/walk,1,100,1\nm/walk,2,3,5\n"));
  EXPECT_THAT(text, HasSubstr("\nm/compass,1,5,7\nm/compass,1,30,1\n"));
}

TEST(StudyTables, ListEveryRealisationWithItsParameters) {
  const Study study;
  const auto text = comparison::realisations_csv(*study.plan, study.results, study.summary);
  EXPECT_EQ(text.find("run,realisation,objective,a [kPa],b [kPa],c [kPa],evaluations,evaluations_to_target,status,"
                      "ended_by,seconds [s],success,stop_reason\n"),
            0u);
  EXPECT_THAT(text, HasSubstr("\nm/walk,3,2,2,1,3,100,,ok,,0.25,0,\n"));
  EXPECT_THAT(text, HasSubstr("\nm/walk,4,1.0002,2,1,3,70,20,ok,,0.25,1,\n"));
}
