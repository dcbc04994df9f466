// SPDX-License-Identifier: Apache-2.0
#include "comparison/run_differences.hpp"

#include <gmock/gmock.h>

#include "execution/laboratory.hpp"

using namespace tunica;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(RunDifferences, SayWhatRunsOfOneModelAndOptimizerHaveThatOthersHaveNot) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk");
  laboratory.add_run("walk", 500).random_start = true;
  laboratory.add_run("compass");
  laboratory.add_run("walk");
  const auto found = comparison::run_differences(laboratory.plan());
  EXPECT_THAT(found, ElementsAre(ElementsAre("max_evaluations 100", "initial given"),
                                 ElementsAre("max_evaluations 500", "initial random"), IsEmpty(),
                                 ElementsAre("max_evaluations 100", "initial given", "other seed")));
}

TEST(RunDifferences, NameLimitsObjectivesAndRealisations) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk").stop.target = 1e-6;
  auto& other = laboratory.add_run("walk", 100, 20);
  other.objective = experiment::ObjectiveType::sum_of_norms;
  const auto found = comparison::run_differences(laboratory.plan());
  EXPECT_THAT(found, ElementsAre(ElementsAre("least_squares", "target 1e-06", "1 realisation"),
                                 ElementsAre("sum_of_norms", "no target", "20 realisations")));
}

TEST(PairedRuns, AreThoseOfTheSameParametersAndBounds) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk");
  laboratory.add_run("compass");
  laboratory.add_run("walk", 500);
  EXPECT_THAT(comparison::paired_runs(laboratory.plan()), ElementsAre(IsEmpty(), IsEmpty(), IsEmpty()));
  laboratory.bench.experiment.paired_starts = true;
  const execution::Plan plan = laboratory.plan();
  EXPECT_THAT(comparison::paired_runs(plan),
              ElementsAre(ElementsAre("m/compass", "m/walk#2"), ElementsAre("m/walk", "m/walk#2"),
                          ElementsAre("m/walk", "m/compass")));
  EXPECT_NE(plan.runs[0].seed, plan.runs[1].seed) << "what is drawn on the way stays each run's own";
  EXPECT_THAT(plan.warnings, IsEmpty());
}

TEST(PairedRuns, AreMissedWhereThereAreNone) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk");
  laboratory.bench.experiment.paired_starts = true;
  const execution::Plan plan = laboratory.plan();
  ASSERT_EQ(plan.warnings.size(), 1u);
  EXPECT_THAT(plan.warnings[0].sentence, HasSubstr("pairs nothing"));
}
