// SPDX-License-Identifier: Apache-2.0
#include "comparison/ranking_table.hpp"

#include <sstream>

#include <gmock/gmock.h>

#include "text/wrapping.hpp"

using namespace tunica::comparison;
using ::testing::HasSubstr;
using ::testing::Not;
using tunica::execution::WarningKind;
using tunica::text::columns;

namespace {

Estimate estimate(double value, std::optional<Interval> ci95, Estimate::Bound bound = Estimate::Bound::none) {
  Estimate result;
  result.name = "mu";
  result.unit = "kPa";
  result.value = value;
  result.ci95 = ci95;
  result.identified = ci95.has_value();
  result.assessed = true;
  result.at_bound = bound;
  return result;
}

}  // namespace

TEST(RankingTable, WritesValuesWithTheirUncertainty) {
  EXPECT_EQ(value_text(estimate(22.3861, Interval{21.9, 22.8722})).plain(), "22.386 ± 0.49 kPa");
  EXPECT_EQ(value_text(estimate(22.4, Interval{21.9, 25})).plain(), "22.4 kPa (21.9 … 25)");
  EXPECT_EQ(value_text(estimate(22.4, {})).plain(), "22.4 kPa  (not fixed by the data)");
  EXPECT_EQ(value_text(estimate(200, {}, Estimate::Bound::upper)).plain(), "200 kPa  <- at its upper bound");
}

TEST(RankingTable, BeginsWithTheWarningsAndShowsRunsWithoutAResult) {
  Summary summary;
  summary.warnings = {{WarningKind::set_up, "something is odd"}};
  RunSummary failed;
  failed.label = "gho/es";
  failed.group = "least_squares on circ";
  failed.status = tunica::Status::failed("row 3: no root");
  failed.evaluations = failed.failures = 200;
  failed.realisations = 1;
  summary.runs.push_back(failed);
  summary.ranking.push_back({0, {}});
  const auto text = ranking_table(summary).plain();
  EXPECT_EQ(text.find("Warnings\n  ! something is odd\n"), 0u);
  EXPECT_THAT(text, HasSubstr("     no result: row 3"));
  EXPECT_THAT(text, HasSubstr("no result: row 3: no root"));
}

TEST(RankingTable, KeepsLongLabelsAndTheReasonsOfRunsThatDoNotCount) {
  Summary summary;
  RunSummary good;
  good.label = "a_model_with_a_long_name/and_its_optimizer";
  good.group = "least_squares on circ";
  good.has_result = true;
  good.objective = 1.2345678e-21;
  good.realisations = 20;
  good.successes = 19;
  good.evaluations_to_target = sample_statistics(std::vector<double>{1234567, 1234567});
  good.expected_running_time = 123456789;
  good.seconds = 123456;
  good.evaluations = 34567;
  good.jacobians = 20000;
  good.certificate.sentence = "no better neighbour";
  RunSummary broken = good;
  broken.label = "b/es";
  broken.status = tunica::Status::infeasible("unstable at stretch 1.2", 0.3);
  summary.runs = {good, broken};
  summary.ranking = {{0, 1, 0.0}, {1, 2, 12.34567}};
  const auto text = ranking_table(summary).plain();
  EXPECT_THAT(text,
              HasSubstr("\n 1 a_model_with_a_long_name/and_its_optimizer\n                        1.2346e-21   19/20 "
                        "1.2e+08   34567   20000 123456      0\n"));
  EXPECT_THAT(text, HasSubstr("12.3\n     no feasible point; least violation 0.3: unstable at stretch 1.2\n"));
  EXPECT_THAT(text, HasSubstr("ΔAICc"));
  EXPECT_THAT(text, HasSubstr("  optimum: no better neighbour\n"));
}

TEST(RankingTable, SaysWhatEndedARunAndWhetherItsBestSearchHadConverged) {
  Summary summary;
  RunSummary run;
  run.label = "m/lm";
  run.group = "g";
  run.has_result = true;
  run.reason = "the reason";
  summary.ranking = {{0, 1, std::nullopt}};
  using tunica::search::StopReason;
  const auto text = [&](bool converged, StopReason stop) {
    run.converged = converged;
    run.stopped_by = stop;
    run.stop_sentence = stop == StopReason::none ? "" : "stall";
    summary.runs = {run};
    return ranking_table(summary).plain();
  };
  EXPECT_THAT(text(true, StopReason::none), HasSubstr("m/lm  (converged: the reason)\n"));
  EXPECT_THAT(text(false, StopReason::none), HasSubstr("m/lm  (not converged: the reason)\n"));
  EXPECT_THAT(text(true, StopReason::stall),
              HasSubstr("m/lm  (ended by stall; the search that found the best point had converged: the\n"));
  EXPECT_THAT(text(false, StopReason::stall),
              HasSubstr("m/lm  (ended by stall; the search that found the best point had not converged:\n"));
  EXPECT_THAT(text(true, StopReason::target), HasSubstr("m/lm  (ended at its target)\n"));
}

TEST(RankingTable, NamesTheTargetThatRunsAreRankedAt) {
  Summary summary;
  RunSummary run;
  run.label = "m/lm";
  run.group = "g";
  run.has_result = true;
  run.target = 0.25;
  summary.runs = {run, run};
  summary.ranking = {{0, 1, std::nullopt}, {1, 2, std::nullopt}};
  EXPECT_THAT(ranking_table(summary).plain(), HasSubstr("Ranking by success, then ERT, at the target 0.25: g\n"));
}

TEST(RankingTable, GivesMeanAndDeviationOverRealisations) {
  Summary summary;
  RunSummary run;
  run.label = "m/lm";
  run.group = "g";
  run.has_result = true;
  run.parameters = {estimate(22.4, Interval{21.9, 22.9})};
  run.parameters[0].over_realisations = sample_statistics(std::vector<double>{22, 23});
  run.objectives = sample_statistics(std::vector<double>{1, 3});
  summary.runs = {run};
  summary.ranking = {{0, 1, std::nullopt}};
  EXPECT_THAT(ranking_table(summary).plain(),
              HasSubstr("  over realisations: objective 2 ± 1.4, mu 22.5 ± 0.71 kPa (mean ± sd"));
}

TEST(RankingTable, SaysNothingOfTheDataAtAPointThatIsNoFit) {
  Summary summary;
  RunSummary run;
  run.label = "m/lm";
  run.group = "g";
  run.has_result = true;
  run.status = tunica::Status::infeasible("x", 1);
  run.parameters = {estimate(22.4, std::nullopt)};
  run.parameters[0].assessed = false;
  summary.runs = {run};
  summary.ranking = {{0, 1, std::nullopt}};
  EXPECT_THAT(ranking_table(summary).plain(), ::testing::Not(HasSubstr("not fixed by the data")));
  summary.runs[0].parameters[0].assessed = true;
  EXPECT_THAT(ranking_table(summary).plain(), HasSubstr("(not fixed by the data)"));
  summary.runs[0].parameters[0].held = true;
  EXPECT_THAT(ranking_table(summary).plain(), HasSubstr("(held by a constraint)"));
}

TEST(RankingTable, ShowsProfilesAndBootstrapBelowTheValue) {
  Summary summary;
  RunSummary run;
  run.label = "gho/lm";
  run.group = "g";
  run.has_result = true;
  run.parameters = {estimate(22.4, Interval{21.9, 22.9})};
  run.parameters[0].profile = ProfileInterval{21.8, std::nullopt};
  run.parameters[0].bootstrap = Interval{21.7, 23.1};
  run.uncertainty = {"the profile of mu is open towards the upper bound"};
  summary.runs = {run};
  summary.ranking = {{0, 1, std::nullopt}};
  const auto text = ranking_table(summary).plain();
  EXPECT_THAT(text, HasSubstr("\n            profile (21.8 … open), bootstrap (21.7 … 23.1)\n"));
  EXPECT_THAT(text, HasSubstr("\n  - the profile of mu is open towards the upper bound\n"));
}

TEST(RankingTable, ShowsTheMisfitOverStatedNoiseAndInWhatItDiffersFromNone) {
  Summary summary;
  RunSummary run;
  run.label = "gho/lm";
  run.group = "least_squares on circ";
  run.has_result = true;
  run.realisations = 1;
  run.misfit = tunica::assembly::Misfit{4538, 514, 506, 0, 0};
  run.notes = {"a note"};
  summary.runs = {run};
  summary.ranking = {{0, 1, {}}};
  const auto text = ranking_table(summary).plain();
  EXPECT_THAT(text, HasSubstr("   Jac    sec   χ²/ν\n"));
  EXPECT_THAT(text, HasSubstr("   8.97\n"));
  EXPECT_THAT(text, HasSubstr("\n  misfit: χ²/ν 8.97 (χ² 4538, ν 506), 3 times the stated noise: the model misses"));
  EXPECT_THAT(text, HasSubstr("\n  - a note\n"));
  summary.runs[0].misfit->chance = 0.5;
  EXPECT_THAT(ranking_table(summary).plain(), Not(HasSubstr("the model misses")));
  summary.runs[0].misfit.reset();
  EXPECT_THAT(ranking_table(summary).plain(), Not(HasSubstr("χ²")));
}

TEST(RankingTable, SaysByWhatRunsOfOneLabelDiffer) {
  Summary summary;
  RunSummary run;
  run.label = "gho/es";
  run.group = "least_squares on circ";
  run.has_result = true;
  run.differs = {"h = 0.7", "20 realisations"};
  summary.runs = {run, run};
  summary.runs[1].label = "gho/es#2";
  summary.runs[1].differs = {"free", "1 realisation"};
  for (RunSummary& one : summary.runs) one.stability.emplace();
  summary.runs[0].stability->imposed = "h = 0.7";
  summary.ranking = {{0, 1, {}}, {1, 2, {}}};
  const auto text = ranking_table(summary).plain();
  EXPECT_THAT(text, HasSubstr("\n 1 gho/es (h = 0.7, 20 realisations)\n"));
  EXPECT_THAT(text, HasSubstr("\n 2 gho/es#2 (free, 1 realisation)\n")) << "the constraint stands once";
}

TEST(RankingTable, ShowsFullSimulationsAndFailuresWhereThereAreSome) {
  Summary summary;
  RunSummary run;
  run.label = "gho/es";
  run.group = "least_squares on circ";
  run.has_result = true;
  run.evaluations = 1200;
  run.jacobians = 77;
  summary.runs = {run};
  summary.ranking = {{0, 1, {}}};
  EXPECT_THAT(ranking_table(summary).plain(), HasSubstr("ERT   total     Jac    sec\n"));
  EXPECT_THAT(ranking_table(summary).plain(), HasSubstr("-    1200      77  0.000\n"));
  summary.runs[0].has_costly_tests = true;
  summary.runs[0].simulated = 310;
  summary.runs[0].failures = 4;
  EXPECT_THAT(ranking_table(summary).plain(), HasSubstr("ERT     sim     Jac    sec failed\n"));
  EXPECT_THAT(ranking_table(summary).plain(), HasSubstr("-     310      77  0.000      4\n"));
}

TEST(RankingTable, FitsInto80ColumnsHoweverLongTheNames) {
  const std::string name(60, 'x');
  Summary summary;
  summary.warnings = {
      {WarningKind::set_up, name + " is odd in many ways, and this sentence says at length in which of them"}};
  RunSummary run;
  run.label = name + "/" + name;
  run.group = "least_squares on " + name + ", " + name;
  run.has_result = true;
  run.objective = 1.2345678e-21;
  run.realisations = 20;
  run.successes = 19;
  run.reason = "the largest of 20 starts was evaluated, and the others came to the same point within rounding";
  run.parameters = {estimate(-1.234567e-5, Interval{-2.3456e-5, 9.8765e-5}, Estimate::Bound::upper)};
  run.parameters[0].name = name + "." + name;
  run.misfit = run.misfit_estimated = tunica::assembly::Misfit{1.23456e9, 1234567, 1234567, 0, 12345};
  run.notes = {name + " is not stated " + name};
  run.quality.resize(1);
  run.quality[0].test = name;
  run.quality[0].channel = "transverse_stretch";
  run.certificate.sentence = "no better neighbour " + name;
  run.stability.emplace();
  run.stability->imposed = "h(stretch), admissible";
  run.stability->ratio_to_free = 5.33;
  run.stability->models.resize(1);
  for (const double stretch : {1.25, 1.5}) {
    tunica::stability::TransverseVerdict verdict;
    verdict.axis = stretch < 1.4 ? 0 : 1;
    verdict.first_unstable = stretch;
    run.stability->models[0].verdict.transverse.push_back(verdict);
  }
  run.stability->models[0].verdict.domain.largest = 1.5;
  run.has_costly_tests = true;
  run.failures = 1234567;
  run.jacobians = run.simulated = 123456789;
  run.expected_running_time = 1.23456789e12;
  run.seconds = 123456;
  summary.runs = {run, run};
  summary.ranking = {{0, 1, 0.0}, {1, 2, 12.34567}};
  const auto text = ranking_table(summary).plain();
  EXPECT_THAT(text, HasSubstr("1.250 circ")) << "the table of stability is missing";
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    // A single name of more than 80 columns cannot be broken, and stands alone.
    const bool alone = line.find_first_of(' ', line.find_first_not_of(' ')) == line.npos;
    EXPECT_TRUE(alone || columns(line) <= 80) << columns(line) << ": " << line;
  }
}
