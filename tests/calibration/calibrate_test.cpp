// SPDX-License-Identifier: Apache-2.0
#include "calibration/calibrate.hpp"

#include <algorithm>
#include <thread>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "calibration/calibrating.hpp"
#include "comparison/certify.hpp"
#include "execution/interrupt.hpp"
#include "tunica/error.hpp"

namespace tunica {
namespace {

using calibration::Certified;
using ::testing::HasSubstr;
using trial::Calibrating;

using Ending = calibration::Outcome::Ending;

TEST(Calibrate, LeavesResultsTablesAndAReport) {
  Calibrating trial;
  trial.bench.experiment.tests.front().type = "answering_curve";
  trial.add_run("compass", 2000);
  const auto outcome = trial.calibrate();
  EXPECT_EQ(outcome.ending, Ending::finished);
  EXPECT_EQ(outcome.write_failure, "");
  EXPECT_EQ(outcome.directory, trial.folder.path() / "out");
  EXPECT_EQ(outcome.result, trial.out("result.json"));
  EXPECT_EQ(outcome.report, trial.out("report.html"));
  for (const char* file : {"result.json", "report.html", "evaluations.csv", "checkpoint.json", "input.json", "run.log",
                           "fit_curve.csv", "wall_curve.csv", "stability.csv", "ranking.csv", "realisations.csv"})
    EXPECT_TRUE(trial.has(file)) << file;
  EXPECT_FALSE(trial.has("best_points.json")) << "was for another process";
  ASSERT_EQ(outcome.summary.runs.size(), 1u);
  EXPECT_NEAR(outcome.summary.runs[0].parameters[0].value, 2, 0.05) << "a of the made-up data";
  const auto result = nlohmann::json::parse(trial::text_of(outcome.result));
  EXPECT_EQ(result["runs"][0]["best"]["objective"], outcome.summary.runs[0].objective);
  EXPECT_EQ(result["provenance"]["plugins"], (std::vector<std::string>{"answers 1", "fakes 1"}));
  EXPECT_EQ(outcome.provenance.plugins, (std::vector<std::string>{"answers 1", "fakes 1"}));
  EXPECT_TRUE(outcome.sound());
}

TEST(Calibrate, TellsBeforeTheFirstEvaluationWhatIsSearchedAndWhere) {
  Calibrating trial;
  trial.add_run("compass");
  trial.add_run("residual");
  trial.count_calls();
  int told = 0;
  trial.options.started = [&](const calibration::Start& start) {
    ++told;
    EXPECT_EQ(trial.calls, 0);
    EXPECT_EQ(start.plan.tasks.size(), 2u);
    EXPECT_EQ(start.directory, trial.folder.path() / "out");
  };
  static_cast<void>(trial.calibrate());
  EXPECT_EQ(told, 1);
}

TEST(Calibrate, HandsOnWhyPluginsWereRefused) {
  Calibrating trial;
  trial.add_run("residual");
  trial.options.refusals = {"gho.so: is not for this version"};
  const auto outcome = trial.calibrate();
  EXPECT_TRUE(std::ranges::any_of(outcome.summary.warnings, [](const execution::Warning& warning) {
    return warning.kind == execution::WarningKind::plugin_refused &&
           warning.sentence.find("gho.so") != std::string::npos;
  }));
}

TEST(Calibrate, AsksAnotherProcessAboutTheBestPoints) {
  Calibrating trial;
  trial.add_run("compass", 2000);
  std::string points;
  trial.options.certify = [&](const std::filesystem::path& directory, const std::filesystem::path& file) -> Certified {
    EXPECT_EQ(directory, trial.folder.path() / "out");
    points = trial::text_of(file);
    const auto plan = trial.plan();
    return {comparison::certify(plan, points), ""};
  };
  const auto outcome = trial.calibrate();
  const auto& run = outcome.summary.runs.front();
  EXPECT_EQ(nlohmann::json::parse(points)["runs"][0]["best"]["parameters"]["a"]["value"], run.parameters[0].value);
  EXPECT_FALSE(trial.has("best_points.json"));
  ASSERT_TRUE(run.certificate.fresh) << run.certificate.missing;
  EXPECT_TRUE(run.certificate.fresh->identical);
}

TEST(Calibrate, SaysWhyThereIsNoCertificate) {
  Calibrating trial;
  trial.add_run("residual");
  EXPECT_THAT(trial.calibrate().summary.runs.front().certificate.sentence, HasSubstr("--no-certificate was given"));
  trial.options.directory = trial.folder.path() / "again";
  trial.options.certify = [](const auto&, const auto&) -> Certified { return {"", "it was killed"}; };
  const auto outcome = trial.calibrate();
  EXPECT_FALSE(outcome.summary.runs.front().certificate.fresh);
  EXPECT_THAT(outcome.summary.runs.front().certificate.sentence, HasSubstr("it was killed"));
}

TEST(Calibrate, WaitsForTheCertificateOnlyWhereThereIsOneThread) {
  for (const unsigned threads : {1u, 2u}) {
    Calibrating trial;
    trial.add_run("residual");
    trial.options.threads = threads;
    std::thread::id asking;
    trial.options.certify = [&](const auto&, const auto&) -> Certified {
      asking = std::this_thread::get_id();
      return {"", "nothing to say"};
    };
    static_cast<void>(trial.calibrate());
    EXPECT_EQ(asking == std::this_thread::get_id(), threads == 1) << threads << " threads";
  }
}

TEST(Calibrate, MakesTheAnalysisThatIsAskedFor) {
  Calibrating trial;
  trial.add_run("compass", 2000);
  trial.bench.experiment.analysis.profiles = {"a"};
  trial.bench.experiment.analysis.optimizer = "residual";
  const auto outcome = trial.calibrate();
  EXPECT_EQ(outcome.ending, Ending::finished);
  EXPECT_TRUE(trial.has("profile_a.csv"));
  EXPECT_FALSE(outcome.summary.runs.front().uncertainty.empty());
}

TEST(Calibrate, RefusesAnAnalysisBeforeItSearches) {
  Calibrating trial;
  trial.add_run("compass");
  trial.count_calls();
  trial.bench.experiment.analysis.profiles = {"stiffness"};
  EXPECT_THAT(fakes::message_of([&] { static_cast<void>(trial.calibrate()); }),
              HasSubstr("no run searches for the parameter 'stiffness'"));
  EXPECT_EQ(trial.calls, 0);
  EXPECT_FALSE(std::filesystem::exists(trial.folder.path() / "out")) << "nothing is left behind";
}

TEST(Calibrate, RefusesWhatDoesNotFitIntoTheMachine) {
  Calibrating trial;
  trial.add_run("compass");
  trial.bench.experiment.analysis.bootstrap_draws = std::uint64_t{1} << 60;
  trial.bench.experiment.analysis.profiles = {"stiffness"};  // refused too, but later
  EXPECT_THAT(fakes::message_of([&] { static_cast<void>(trial.calibrate()); }), HasSubstr("of memory"));
}

TEST(Calibrate, RefusesRunsThatHaveNothingToFit) {
  Calibrating trial;
  trial.bench.add_test("wish", {0, 1, 2}, {1, 2, 3}).measured = false;
  auto& both = trial.add_run("residual");
  EXPECT_EQ(both.tests, (std::vector<std::string>{"curve", "wish"}));
  EXPECT_EQ(trial.calibrate().ending, Ending::finished) << "one test is enough";
  trial.options.directory = trial.folder.path() / "again";
  trial.add_run("residual").tests = {"wish"};
  EXPECT_THAT(fakes::message_of([&] { static_cast<void>(trial.calibrate()); }),
              HasSubstr("run m/residual#2: no test has measured values"));
}

TEST(Calibrate, KeepsOnlyTheEvaluationsThatImprovedWhereThatIsAsked) {
  Calibrating trial;
  trial.add_run("walk", 400);
  static_cast<void>(trial.calibrate());
  const auto lines = [](const std::filesystem::path& file) {
    const std::string text = trial::text_of(file);
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines(trial.out("evaluations.csv")), 1 + 400);
  trial.options.directory = trial.folder.path() / "thin";
  trial.bench.experiment.kept_evaluations = experiment::KeptEvaluations::improvements;
  static_cast<void>(trial.calibrate());
  EXPECT_LT(lines(trial.folder.path() / "thin/evaluations.csv"), 100);
  EXPECT_GT(lines(trial.folder.path() / "thin/evaluations.csv"), 1);
}

TEST(Calibrate, EndsWithoutAResultWhereItIsInterruptedAfterTheSearches) {
  Calibrating trial;
  trial.add_run("residual");
  trial.options.certify = [](const auto&, const auto&) -> Certified {
    execution::InterruptWatch::interrupt();
    return {"", ""};
  };
  const auto interrupted = trial.calibrate();
  EXPECT_EQ(interrupted.ending, Ending::interrupted);
  EXPECT_EQ(interrupted.result, std::filesystem::path());
  EXPECT_FALSE(trial.has("result.json"));
  trial.options.resume = true;
  trial.options.certify = {};
  EXPECT_EQ(trial.calibrate().ending, Ending::finished);
  EXPECT_TRUE(trial.has("result.json"));
}

TEST(Calibrate, IsSoundWhereEveryRunCameToAGoodEnd) {
  calibration::Outcome outcome;
  outcome.summary.runs.resize(2);
  for (auto& run : outcome.summary.runs) run.has_result = run.converged = true;
  EXPECT_TRUE(outcome.sound());
  auto& last = outcome.summary.runs.back();
  last.has_result = false;
  EXPECT_FALSE(outcome.sound()) << "no evaluation succeeded";
  last.has_result = true;
  last.status = Status::infeasible("h", 0.1);
  EXPECT_FALSE(outcome.sound()) << "a constraint is broken";
  last.status = {};
  last.given_up = 1;
  EXPECT_FALSE(outcome.sound()) << "too many failures";
  last.given_up = 0;
  last.faults = 1;
  EXPECT_FALSE(outcome.sound()) << "the optimiser threw";
  last.given_up = 1;
  EXPECT_FALSE(outcome.sound()) << "one realisation each";
}

}  // namespace
}  // namespace tunica
