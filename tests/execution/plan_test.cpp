// SPDX-License-Identifier: Apache-2.0
#include "execution/plan.hpp"

#include <gmock/gmock.h>

#include "execution/folder.hpp"
#include "execution/laboratory.hpp"
#include "tunica/error.hpp"
#include "tunica/random.hpp"

using namespace tunica;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace {

std::string refusal(const trial::Laboratory& laboratory) {
  return trial::message_of<InputError>([&] { laboratory.plan(); });
}

}  // namespace

TEST(Plan, LabelsRunsAndDerivesTheirSeedsByName) {
  trial::Laboratory laboratory;
  laboratory.bench.experiment.seed = 7;
  laboratory.add_run("walk", 10, 2);
  laboratory.add_run("compass");
  laboratory.add_run("walk", 20);
  const auto plan = laboratory.plan();
  EXPECT_EQ(plan.runs[0].label, "m/walk");
  EXPECT_EQ(plan.runs[1].label, "m/compass");
  EXPECT_EQ(plan.runs[2].label, "m/walk#2");
  EXPECT_EQ(plan.runs[2].seed, derive_seed(7, "run m/walk#2"));
  ASSERT_EQ(plan.tasks.size(), 4u);
  EXPECT_EQ(plan.tasks[1].realisation, 2u);
  EXPECT_EQ(plan.tasks[3].run, 2u);
}

TEST(Plan, RefusesToFitNothing) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk");
  for (const char* name : {"a", "b", "c"}) laboratory.bench.parameter(name).fixed = 1;
  EXPECT_THAT(refusal(laboratory), HasSubstr("run m/walk: every parameter is fixed"));
}

TEST(Plan, RefusesAnOptimiserThatNeedsResidualsWhereThereAreNone) {
  trial::Laboratory laboratory;
  laboratory.add_run("residual");
  laboratory.bench.experiment.tests.front().hold_out.all = true;
  EXPECT_THAT(refusal(laboratory), HasSubstr("'residual' (residual) works on residuals, and the objective has none"));
  laboratory.bench.experiment.runs.front().optimizer = "walk";
  EXPECT_THAT(refusal(laboratory), HasSubstr("no row is left to fit"));
}

TEST(Plan, RefusesWeightsThatAreAllZero) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk");
  laboratory.bench.experiment.tests.front().weights = {0};
  EXPECT_THAT(refusal(laboratory), HasSubstr("run m/walk: every row that could be fitted has the weight 0"));
}

TEST(Plan, RefusesAnInfiniteNoise) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk");
  laboratory.bench.experiment.tests.front().data.noise = {{"y", {0, 1e308, 0}}};
  EXPECT_THAT(refusal(laboratory), HasSubstr("the stated noise gives σ = ∞ in row 0; lower noise.absolute"));
}

TEST(Plan, RefusesConstraintsForAnOptimiserThatDoesNotMeetThem) {
  trial::Laboratory laboratory;
  laboratory.bench.model().type = "bordered";
  laboratory.add_run("walk").constraints.push_back({.type = "admissible_parameters", .json = "", .pointer = ""});
  EXPECT_THAT(refusal(laboratory), HasSubstr("run m/walk: the optimiser 'walk' (walk) does not meet constraints"));
}

TEST(Plan, RefusesAnOptimiserThatNeedsDerivativesOfConstraintsWhereThereAreNone) {
  trial::Laboratory laboratory;
  laboratory.bench.model().type = "bordered";
  auto& run = laboratory.add_run("descent");
  run.constraints.push_back({.type = "admissible_parameters", .json = "", .pointer = ""});
  EXPECT_NO_THROW(laboratory.plan());
  laboratory.bench.model().type = "jagged";
  EXPECT_THAT(refusal(laboratory),
              HasSubstr("run m/descent: the optimiser 'descent' (descent) needs derivatives of the constraints"));
}

TEST(Plan, RefusesMoreParametersThanAnOptimiserSearches) {
  trial::Laboratory laboratory;
  laboratory.add_run("narrow");
  EXPECT_THAT(refusal(laboratory),
              HasSubstr("run m/narrow: the optimiser 'narrow' (narrow) can search 2 parameters at most with the "
                        "population it is given, and 3 are free"));
  laboratory.bench.parameter("c").fixed = 0;
  EXPECT_NO_THROW(laboratory.plan());
}

TEST(Plan, RefusesStagesWithinStages) {
  trial::Laboratory laboratory;
  auto& optimizers = laboratory.bench.experiment.optimizers;
  optimizers.push_back(fakes::optimizer_entry("stages"));
  optimizers.back().name = "inner";
  optimizers.back().stages = {{"walk", {}}};
  optimizers.push_back(fakes::optimizer_entry("stages"));
  optimizers.back().name = "outer";
  optimizers.back().stages = {{"inner", {}}};
  laboratory.add_run("outer");
  EXPECT_THAT(refusal(laboratory), HasSubstr("optimizers.outer: the stage 'inner' has stages itself"));
}

TEST(Plan, NamesATypeThatNoPluginProvides) {
  trial::Laboratory laboratory;
  laboratory.bench.experiment.optimizers.push_back(fakes::optimizer_entry("annealing"));
  laboratory.add_run("annealing");
  EXPECT_THAT(refusal(laboratory), HasSubstr("no plugin provides the type 'annealing'"));
}

TEST(Plan, WarnsOfRealisationsThatAreAllTheSame) {
  trial::Laboratory laboratory;
  laboratory.add_run("compass", 100, 5);
  const auto warnings = laboratory.plan().warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings.front().kind, execution::WarningKind::equal_realisations);
  EXPECT_THAT(warnings.front().text(), HasSubstr("its 5 realisations are all the same"));
}
