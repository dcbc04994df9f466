// SPDX-License-Identifier: Apache-2.0
#include "comparison/summary.hpp"

#include <gmock/gmock.h>

#include "comparison/fit_table.hpp"
#include "execution/laboratory.hpp"

using namespace tunica;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

namespace {

/// Two runs on the fakes: one realisation found the truth (a = 2, b = 1, c = 3), one came close, one run failed.
struct Summarised {
  Summarised() {
    laboratory.bench.experiment.tests.front().hold_out.rows = data::RowRange{3, {}, 1};
    laboratory.add_run("walk", 100, 2);
    laboratory.add_run("compass");
    plan.emplace(laboratory.plan());
    results.resize(2);
    results[0].realisations = {realisation(1, {2.5, 1, 3}), realisation(2, {2, 1, 3})};
    execution::RealisationResult failed;
    failed.tally = {150, 0, 150, 0, 0, 150, 0, "row 1: no root"};
    failed.stopped_by = search::StopReason::nothing_succeeded;
    failed.stop_sentence = "nothing succeeded";
    results[1].realisations = {failed};
  }

  execution::RealisationResult realisation(std::uint64_t number, const std::vector<double>& at) const {
    execution::RealisationResult result;
    result.realisation = number;
    result.finished = true;
    result.best.parameters = at;
    result.best.index = 10 * number;
    std::vector<double> per_test(1);
    auto workspace = plan->runs[0].assembly->evaluator().make_workspace();
    static_cast<void>(
        plan->runs[0].assembly->evaluator().evaluate(at, result.best.objective, per_test, {}, {}, *workspace));
    result.trace = {{2, 1e6}, {result.best.index + 1, result.best.objective}};
    result.tally = {100, 20, 4, 0, 0, 100, 0, "row 2: overflow"};
    result.seconds = 0.5;
    return result;
  }
  comparison::Summary summarise() { return comparison::summarise(*plan, results, {"plugin x was refused"}); }

  trial::Laboratory laboratory;
  std::optional<execution::Plan> plan;
  std::vector<execution::RunResult> results;
};

std::vector<std::string> sentences(const comparison::Summary& summary) {
  std::vector<std::string> all;
  for (const auto& warning : summary.warnings) all.push_back(warning.text());
  return all;
}

}  // namespace

TEST(Summary, ReportsTheBestEvaluatedPointAndCountsEverything) {
  Summarised made;
  const auto summary = made.summarise();
  const auto& run = summary.runs[0];
  EXPECT_EQ(run.best_realisation, 2u);
  EXPECT_EQ(run.best_id, 21u);
  EXPECT_EQ(run.parameters[0].value, 2);
  EXPECT_EQ(run.evaluations, 200u);
  EXPECT_EQ(run.failures, 8u);
  EXPECT_EQ(run.jacobians, 40u);
  EXPECT_EQ(run.seconds, 1);
  EXPECT_EQ(run.success_rate, 0.5);
  EXPECT_EQ(run.successes, 1u);
  EXPECT_EQ(run.evaluations_to_target.box->median, 21);
  EXPECT_EQ(*run.expected_running_time, 100 + 21) << "the failed realisation was paid for in full";
  EXPECT_EQ(run.certificate.agreeing, 1u);
  EXPECT_EQ(run.certificate.realisations, 2u);
  EXPECT_EQ(run.objectives.count, 2u);
  EXPECT_DOUBLE_EQ(run.parameters[0].over_realisations.mean, 2.25);
  ASSERT_EQ(run.quality.size(), 2u);
  EXPECT_EQ(run.quality[0].agreement.rows, 3u);
  EXPECT_TRUE(run.quality[1].held_out);
}

TEST(Summary, KeepsARunThatFailedWithItsReason) {
  Summarised made;
  const auto summary = made.summarise();
  EXPECT_FALSE(summary.runs[1].has_result);
  EXPECT_EQ(summary.runs[1].status.reason(), "row 1: no root");
  EXPECT_EQ(summary.ranking[1].run, 1u);
  EXPECT_FALSE(summary.ranking[1].rank);
}

TEST(Summary, WarnsOfWhatNobodyShouldOverlook) {
  Summarised made;
  made.results[0].realisations = {made.realisation(1, {10, 1, 3})};
  made.results[0].realisations[0].best.objective *= 1.5;
  const auto summary = made.summarise();
  const auto warnings = sentences(summary);
  EXPECT_THAT(warnings, Contains(HasSubstr("m/walk: a = 10 kPa lies at its upper bound (10 kPa)")));
  EXPECT_THAT(warnings, Contains(HasSubstr("but the search recorded")));
  EXPECT_THAT(warnings, Contains(HasSubstr("m/walk: 4 of 100 evaluations failed (4 %); the first: row 2: overflow")));
  EXPECT_THAT(warnings,
              Contains(HasSubstr("m/compass: no result: all 150 evaluations failed; the first: row 1: no root")));
  EXPECT_THAT(warnings, Contains(HasSubstr("test curve: some rows are held out")));
  EXPECT_THAT(warnings, Contains("plugin x was refused"));
  const auto named = [&](execution::WarningKind kind, const std::string& run,
                         const std::vector<std::string>& subjects) {
    return std::any_of(summary.warnings.begin(), summary.warnings.end(),
                       [&](const auto& one) { return one.kind == kind && one.run == run && one.subjects == subjects; });
  };
  EXPECT_TRUE(named(execution::WarningKind::at_bound, "m/walk", {"a"}));
  EXPECT_TRUE(named(execution::WarningKind::not_repeatable, "m/walk", {}));
  EXPECT_TRUE(named(execution::WarningKind::no_result, "m/compass", {}));
  EXPECT_TRUE(named(execution::WarningKind::held_out, "", {"curve"}));
  EXPECT_TRUE(named(execution::WarningKind::plugin_refused, "", {}));
}

TEST(Summary, ReportsSearchesThatADefaultBoundEndedAlthoughAnotherOneWon) {
  Summarised made;
  auto& tally = made.results[0].realisations[0].tally;
  tally.starts = 7;
  tally.bound_stops = {{0, true, 3, 9.25}};
  EXPECT_THAT(
      sentences(made.summarise()),
      Contains(HasSubstr("m/walk: 3 of 8 searches stopped at the default upper bound of a (10 kPa), the best of "
                         "them at the objective 9.25; the run ends at")));
}

TEST(Summary, TellsOfAllDefaultBoundsThatEndedSearchesInOneWarning) {
  Summarised made;
  auto& tally = made.results[0].realisations[0].tally;
  tally.starts = 7;
  tally.bound_stops = {{0, true, 3, 9.25}, {1, true, 2, 7.5}};
  const auto summary = made.summarise();
  std::vector<execution::Warning> found;
  for (const auto& one : summary.warnings)
    if (one.kind == execution::WarningKind::stopped_at_default_bound) found.push_back(one);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].sentence, HasSubstr("3 of 8 searches stopped at the default upper bound of a (10 kPa)"));
  EXPECT_THAT(found[0].sentence,
              AllOf(HasSubstr("; 2 at the upper one of b ("), HasSubstr("), the best at 7.5; the run ends at")));
  EXPECT_THAT(found[0].sentence, HasSubstr("widen it with \"max\" of 'a' and \"max\" of 'b'"));
  EXPECT_EQ(found[0].subjects, (std::vector<std::string>{"a", "b"}));
}

// The objective has a unit here, and is far below 1: 40 times the best is worth a look, 4000 times is not.
TEST(Summary, JudgesSearchesAtDefaultBoundsByTheObjectiveOfTheWinner) {
  Summarised made;
  made.laboratory.bench.experiment.runs[0].objective = experiment::ObjectiveType::standardised_quadratic;
  made.plan.emplace(made.laboratory.plan());
  const auto warned = [&](double times) {
    auto found = made.realisation(1, {2.1, 1, 3});
    EXPECT_LT(found.best.objective, 0.01);
    found.tally.starts = 7;
    found.tally.bound_stops = {{0, true, 3, times * found.best.objective}};
    made.results[0].realisations = {found};
    const auto summary = made.summarise();
    return std::any_of(summary.warnings.begin(), summary.warnings.end(),
                       [](const auto& one) { return one.kind == execution::WarningKind::stopped_at_default_bound; });
  };
  EXPECT_TRUE(warned(40));
  EXPECT_FALSE(warned(4000));
}

TEST(Summary, SaysFirstThatTheModelMissesTheDataByFarMoreThanTheStatedNoise) {
  Summarised made;
  made.laboratory.bench.experiment.tests.front().hold_out.rows.reset();
  made.laboratory.bench.experiment.tests.front().data.noise = {{"y", {0.01, 0, 0}}};
  made.plan.emplace(made.laboratory.plan());
  made.results[0].realisations = {made.realisation(1, {10, 1, 3})};
  const auto summary = made.summarise();
  ASSERT_TRUE(summary.runs[0].misfit);
  EXPECT_TRUE(summary.runs[0].misfit->contradicts());
  EXPECT_EQ(summary.warnings.at(0).kind, execution::WarningKind::noise_contradicted);
  EXPECT_EQ(summary.warnings.at(0).run, "m/walk");
  EXPECT_THAT(summary.warnings.at(0).sentence, HasSubstr("times the noise: χ² is "));
  EXPECT_THAT(summary.warnings.at(0).sentence, HasSubstr("tunica diagnose "));
  const auto same = [](const auto& one) { return one.kind == execution::WarningKind::noise_contradicted; };
  EXPECT_EQ(std::count_if(summary.warnings.begin(), summary.warnings.end(), same), 1);
}

TEST(Summary, BlamesTheSearchWhereAnotherRunOfTheModelCameLower) {
  for (const bool constrained : {false, true}) {
    Summarised made;
    made.laboratory.bench.experiment.tests.front().hold_out.rows.reset();
    made.laboratory.bench.experiment.tests.front().data.noise = {{"y", {0.01, 0, 0}}};
    made.plan.emplace(made.laboratory.plan());
    made.results[0].realisations = {made.realisation(1, {10, 1, 3})};
    made.results[1].realisations = {made.realisation(1, {2.01, 1, 3})};
    auto entry = *made.plan->runs[0].entry;
    entry.constraints.resize(constrained ? 1 : 0);  // then it may be the constraint that costs
    made.plan->runs[0].entry = &entry;
    const auto summary = made.summarise();
    const auto& first = summary.warnings.at(0);
    EXPECT_EQ(first.kind,
              constrained ? execution::WarningKind::noise_contradicted : execution::WarningKind::search_fell_short);
    EXPECT_EQ(first.run, "m/walk");
    if (!constrained) {
      EXPECT_THAT(first.sentence, HasSubstr("and that of m/compass is "));
    }
  }
}

TEST(Summary, SaysFirstThatTheRowsScatterByFarLessThanTheStatedNoise) {
  Summarised made;
  made.laboratory.bench.experiment.tests.front().hold_out.rows.reset();
  made.laboratory.bench.experiment.tests.front().data.noise = {{"y", {1e6, 0, 0}}};
  made.plan.emplace(made.laboratory.plan());
  made.results[0].realisations = {made.realisation(1, {9, 1, 3})};
  const auto summary = made.summarise();
  ASSERT_TRUE(summary.runs[0].misfit);
  EXPECT_TRUE(summary.runs[0].misfit->falls_short());
  EXPECT_FALSE(summary.runs[0].misfit->contradicts());
  EXPECT_EQ(summary.warnings.at(0).kind, execution::WarningKind::noise_too_large);
  EXPECT_THAT(summary.warnings.at(0).text(), HasSubstr("times the stated noise: σ of 'y' of test 'curve' is 1e+06"));
  EXPECT_THAT(summary.warnings.at(0).text(), HasSubstr("Correct the noise, or the unit of the data"));
}

TEST(Summary, SaysFirstThatAMisfitIsOutOfAllScale) {
  Summarised made;
  made.laboratory.bench.experiment.tests.front().hold_out.rows.reset();
  made.laboratory.bench.experiment.tests.front().data.noise = {{"y", {1e-14, 0, 0}}};
  made.plan.emplace(made.laboratory.plan());
  made.results[0].realisations = {made.realisation(1, {9, 1, 3})};
  const auto summary = made.summarise();
  EXPECT_EQ(summary.warnings.at(0).kind, execution::WarningKind::misfit_out_of_scale);
  EXPECT_THAT(summary.warnings.at(0).text(),
              HasSubstr("m/walk: NOT A FIT: 'y' of test 'curve' lies 7e+14 times its noise away on average, so that "
                        "objective and intervals mean nothing: σ is 1e-14"));
}

TEST(Summary, SaysFirstThatThereIsNoMisfitAtAll) {
  Summarised made;
  made.laboratory.bench.experiment.tests.front().hold_out.rows.reset();
  made.plan.emplace(made.laboratory.plan());
  made.results[0].realisations = {made.realisation(1, {2, 1, 3})};
  EXPECT_EQ(made.summarise().warnings.at(0).kind, execution::WarningKind::no_misfit);
  EXPECT_THAT(made.summarise().warnings.at(0).sentence, HasSubstr("The model repeats the data to the last digit"));
  made.laboratory.bench.experiment.tests.front().data.noise = {{"y", {1e200, 0, 0}}};
  made.plan.emplace(made.laboratory.plan());
  made.results[0].realisations = {made.realisation(1, {9, 1, 3})};
  EXPECT_THAT(made.summarise().warnings.at(0).sentence,
              HasSubstr("The noise of 'y' of test 'curve' hides every deviation: σ is 1e+200"));
}

TEST(Summary, WarnsOfEqualCoursesBesideAnOptimiserThatCrashed) {
  Summarised made;
  execution::RealisationResult crashed = made.realisation(3, {2, 1, 3});
  crashed.stopped_by = search::StopReason::optimizer_failure;
  crashed.reason = "thrown";
  auto first = made.realisation(1, {2, 1, 3}), second = made.realisation(2, {2, 1, 3});
  second.trace = first.trace;
  crashed.trace.clear();
  for (auto* one : {&first, &second, &crashed}) one->tally = {100, 20, 0, 0, 0, 100, 0, ""};
  made.results[0].realisations = {first, second, crashed};
  const auto warnings = sentences(made.summarise());
  EXPECT_THAT(warnings, Contains(HasSubstr("an error of the optimiser ended 1 of 3 realisations: thrown")));
  EXPECT_THAT(warnings,
              Contains(HasSubstr("m/walk: all 2 realisations without such an error improved by the same steps")));
}

TEST(Summary, SaysWhyASearchEndedBeforeItEvaluatedAnything) {
  Summarised made;
  execution::RealisationResult crashed;
  crashed.realisation = 1;
  made.results[0].realisations = {crashed};
  EXPECT_THAT(sentences(made.summarise()), Contains(HasSubstr("no result: nothing was evaluated")));
  made.results[0].realisations[0].stopped_by = search::StopReason::optimizer_failure;
  made.results[0].realisations[0].reason = "plugin 'walk' failed: std::bad_alloc";
  EXPECT_THAT(sentences(made.summarise()), Contains(HasSubstr("no result: plugin 'walk' failed: std::bad_alloc")));
  EXPECT_EQ(made.summarise().runs[0].status.reason(), "plugin 'walk' failed: std::bad_alloc");
}

TEST(Summary, TellsTheMostFrequentReasonsOfFailures) {
  Summarised made;
  made.results[0].realisations[0].tally.reasons = {{"a", 1}, {"b", 3}, {"c", 2}};
  made.results[0].realisations[1].tally.reasons = {{"d", 1}, {"c", 9}};
  EXPECT_THAT(sentences(made.summarise()),
              Contains(HasSubstr("; 11 times: c; 3 times: b; 1 time: a; and other reasons")));
}

TEST(FitTable, ShowsMeasuredPredictedAndWhatWasHeldOut) {
  Summarised made;
  const auto summary = made.summarise();
  const auto text = comparison::fit_table(*made.plan, summary, "curve");
  EXPECT_EQ(text.find("run,x [1],y [kPa],y.predicted [kPa],held_out"), 0u);
  EXPECT_THAT(text, HasSubstr("\nm/walk,0,2,2,0"));
  EXPECT_THAT(text, HasSubstr("\nm/walk,1,6,6,1"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("m/compass")));
}

TEST(FitTable, HasTheIntervalOfTheCurveAndTheRangeOverRealisations) {
  Summarised made;
  const auto summary = made.summarise();
  const auto text = comparison::fit_table(*made.plan, summary, "curve");
  const auto header = text.substr(0, text.find('\n'));
  EXPECT_TRUE(header.ends_with("held_out,twice_x,y.ci95 [kPa],y.lowest [kPa],y.highest [kPa]")) << header;
  // At x = 0 the curve is a: 2 and 2.5 in the two realisations.
  const auto row = text.substr(text.find("\nm/walk,0,2,2,0") + 1);
  EXPECT_TRUE(row.substr(0, row.find('\n')).ends_with(",2,2.5")) << row;
  made.results[0].realisations.pop_back();
  EXPECT_THAT(comparison::fit_table(*made.plan, made.summarise(), "curve"), ::testing::Not(HasSubstr("lowest")));
}
