// SPDX-License-Identifier: Apache-2.0
#include "comparison/conclusion.hpp"

#include <gmock/gmock.h>

#include "comparison/summary.hpp"
#include "search/ledger.hpp"

using namespace tunica;
using comparison::Ending;
using comparison::ending_of;
using comparison::RunSummary;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

RunSummary converged() {
  RunSummary run;
  run.has_result = run.converged = true;
  run.evaluations = 100;
  run.reason = "it met a tolerance";
  return run;
}

void add_curve(RunSummary& run, double r2) {
  comparison::Quality quality;
  quality.test = "strip";
  quality.channel = "stress";
  quality.agreement.r2 = r2;
  run.quality.push_back(quality);
}

}  // namespace

TEST(Ending, IsConvergedWhereNothingSpeaksAgainstIt) {
  RunSummary run = converged();
  add_curve(run, 0.9);
  EXPECT_EQ(ending_of(run), Ending::converged);
  EXPECT_EQ(words_on_ending(run), "converged: it met a tolerance");
}

TEST(Ending, IsNotConvergedBesideAMajorityOfFailures) {
  RunSummary run = converged();
  run.failures = 50;
  EXPECT_EQ(ending_of(run), Ending::converged);
  run.failures = 51;
  EXPECT_EQ(ending_of(run), Ending::mostly_failed);
  EXPECT_FALSE(succeeded(ending_of(run)));
  EXPECT_THAT(words_on_ending(run), HasSubstr("51 of 100 evaluations failed"));
  EXPECT_THAT(words_on_ending(run), Not(HasSubstr("converged")));
}

TEST(Ending, IsNoFitWhereEveryCurveIsWorseThanItsMean) {
  RunSummary run = converged();
  add_curve(run, -5.3);
  EXPECT_EQ(ending_of(run), Ending::not_a_fit);
  EXPECT_FALSE(succeeded(ending_of(run)));
  EXPECT_THAT(words_on_ending(run), HasSubstr("R² is -5.3 in strip, stress"));
  EXPECT_THAT(words_on_ending(run), Not(HasSubstr("converged")));
  add_curve(run, 0.9);
  EXPECT_EQ(ending_of(run), Ending::misses);
  EXPECT_TRUE(succeeded(ending_of(run)));
  EXPECT_THAT(words_on_ending(run), Not(HasSubstr("converged")));
}

TEST(Ending, IsNoOptimumWhereABetterPointIsNear) {
  RunSummary run = converged();
  run.certificate.verdict = comparison::CertificateVerdict::not_an_optimum;
  EXPECT_EQ(ending_of(run), Ending::not_an_optimum);
  EXPECT_FALSE(succeeded(ending_of(run)));
  EXPECT_THAT(words_on_ending(run), Not(HasSubstr("converged")));
  run.stopped_by = search::StopReason::max_evaluations;
  EXPECT_EQ(ending_of(run), Ending::short_of_optimum) << "the file asked for this end";
  EXPECT_TRUE(succeeded(ending_of(run)));
}

TEST(Ending, NamesTheKeyThatRaisesTheLimit) {
  RunSummary run = converged();
  run.converged = false;
  EXPECT_EQ(ending_of(run), Ending::not_converged);
  EXPECT_FALSE(succeeded(ending_of(run)));
  run.limit = {"optimizers.lm.max_iterations", "2"};
  EXPECT_THAT(words_on_ending(run), HasSubstr("optimizers.lm.max_iterations = 2: raise it to search on"));
  run.limit = {"stop.max_evaluations", "500"};
  run.stopped_by = search::StopReason::max_evaluations;
  run.stop_sentence = "max_evaluations";
  EXPECT_EQ(ending_of(run), Ending::at_limit);
  EXPECT_THAT(words_on_ending(run), HasSubstr("ended by max_evaluations, stop.max_evaluations = 500: raise it"));
}

TEST(Misfit, ThatIsSmallAndRealIsNeitherNothingNorAContradiction) {
  assembly::Misfit misfit;
  misfit.rows = 3003;
  misfit.freedom = 3000;
  misfit.chi_square = 1.18 * misfit.freedom;
  misfit.chance = 4e-12;
  EXPECT_FALSE(misfit.contradicts());
  EXPECT_TRUE(misfit.small_but_real());
  EXPECT_NEAR(misfit.systematic(), 0.4243, 1e-4);
  EXPECT_NEAR(misfit.half_widths(), 11.86, 0.01);
  misfit.chance = 0.3;
  EXPECT_FALSE(misfit.small_but_real());
}

TEST(BoundStops, AreCountedWithTheLeastObjectiveOfTheSearchesThatEndedThere) {
  search::Tally tally, other;
  tally.add_start(std::vector{1.0, 0.5}, 9);
  tally.add_start(std::vector{0.4, 0.5}, 2);
  other.add_start(std::vector{1.0, 0.0}, 7);
  tally.add(other);
  EXPECT_EQ(tally.starts, 3u);
  ASSERT_EQ(tally.bound_stops.size(), 2u);
  EXPECT_TRUE(tally.bound_stops[0].upper);
  EXPECT_EQ(tally.bound_stops[0].count, 2u);
  EXPECT_EQ(tally.bound_stops[0].objective, 7);
  EXPECT_EQ(tally.bound_stops[1].parameter, 1u);
}

TEST(Bound, IsADefaultAChoiceOrAnEndBeyondWhichNothingIsNew) {
  using Bound = assembly::FreeParameter::Bound;
  const auto free = [](const char* unit, double min, double max) {
    assembly::FreeParameter one{"x", unit, min, max, min, Scale::linear, {}, {min, max}};
    return one;
  };
  EXPECT_EQ(free("kPa", 0.01, 1000).kind_of(true), Bound::by_default);
  EXPECT_EQ(free("kPa", 0, 1000).kind_of(false), Bound::physical);
  EXPECT_EQ(free("deg", 0, 90).kind_of(true), Bound::symmetry);
  EXPECT_EQ(free("1", 0, 1.0 / 3).kind_of(true), Bound::physical);
  auto own = free("kPa", 0.01, 1000);
  own.max = 50;
  own.own_max = true;
  EXPECT_EQ(own.kind_of(true), Bound::chosen);
  auto rounded = free("1", 0, 1.0 / 3);
  rounded.max = 0.3333;
  rounded.own_max = true;
  EXPECT_EQ(rounded.kind_of(true), Bound::physical);
}
