// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/recording.hpp"
#include "search/calibration_problem.hpp"

namespace tunica {
namespace {

using fakes::Bench;
using fakes::Recording;
using search::CalibrationProblem;
using testing::HasSubstr;

class Resuming : public testing::Test {
 protected:
  Resuming() { bench_.add_test("t", {0, 1, 2}, {1, 2, 3}); }

  /// Five evaluations: two single, a batch of two, a linearisation.
  static void search(CalibrationProblem& problem, double shift = 0) {
    double objective = 0;
    static_cast<void>(problem.evaluate(std::vector<double>{0.2, 0.5, 0.5}, objective));
    static_cast<void>(problem.evaluate(std::vector<double>{0.3 + shift, 0.5, 0.5}, objective));
    std::vector<double> xs{0.4, 0.5, 0.5, 0.5, 0.5, 0.5}, objectives(2), residuals(3), jacobian(9);
    std::vector<Status> statuses(2);
    problem.evaluate_batch(xs, objectives, statuses);
    static_cast<void>(problem.linearise(std::vector<double>{0.6, 0.5, 0.5}, objective, residuals, jacobian));
  }

  Recording record(const search::Replay& replay, double shift = 0) {
    Recording recording;
    CalibrationProblem::Settings settings;
    settings.record = recording.recorder();
    settings.replay = replay;
    CalibrationProblem problem(assembly_ ? *assembly_ : assembly_.emplace(bench_.experiment, bench_.run, bench_.shelf),
                               settings);
    search(problem, shift);
    return recording;
  }

  Bench bench_;
  std::optional<assembly::Assembly> assembly_;
};

TEST_F(Resuming, TakesKnownEvaluationsFromTheJournal) {
  const Recording whole = record({});
  int calls = 0;
  fakes::set_behaviour([&](double, std::span<double>, Status&) { ++calls; });
  for (std::size_t known = 0; known <= 5; ++known) {
    calls = 0;
    EXPECT_EQ(record(whole.replay(known)).lines, whole.lines) << known;
    EXPECT_EQ(calls, 5 - static_cast<int>(std::min<std::size_t>(known, 4))) << "the linearisation is made again";
  }
}

TEST_F(Resuming, KeepsRecordedFailures) {
  fakes::set_behaviour([](double a, std::span<double>, Status& status) {
    if (a > 3.5 && a < 4.5) status = Status::failed("in between");
  });
  const Recording whole = record({});
  EXPECT_EQ(whole.lines[2].kind, Status::Kind::failed);
  EXPECT_EQ(record(whole.replay(4)).lines, whole.lines);
}

TEST_F(Resuming, RefusesOtherParameters) {
  const Recording whole = record({});
  EXPECT_THAT(fakes::message_of([&] { record(whole.replay(5), 1e-9); }),
              HasSubstr("evaluation 2 of the journal cannot be continued: a was 3 and is now 3.0000000"));
}

TEST_F(Resuming, RefusesAnObjectiveItCannotReproduce) {
  Recording changed = record({});
  changed.lines[4].objective = std::nextafter(changed.lines[4].objective, 1e300);
  EXPECT_THAT(fakes::message_of([&] { record(changed.replay(5)); }),
              HasSubstr("evaluation 5 of the journal cannot be continued: the objective was"));
  changed = record({});
  changed.lines[4].kind = Status::Kind::failed;
  EXPECT_THAT(fakes::message_of([&] { record(changed.replay(5)); }),
              HasSubstr("its status was 'failed' and is now 'ok'"));
}

TEST_F(Resuming, RefusesAJournalOfAnotherShape) {
  Recording changed = record({});
  changed.lines[0].parameters.pop_back();
  EXPECT_THAT(fakes::message_of([&] { record(changed.replay(5)); }),
              HasSubstr("it has 2 parameters and 1 tests where the run has 3 and 1"));
}

TEST_F(Resuming, NumbersALaterStageOn) {
  const assembly::Assembly assembly = bench_.assemble();
  Recording recording;
  CalibrationProblem::Settings settings;
  settings.record = recording.recorder();
  settings.first_index = 40;
  settings.stop.max_evaluations = 5;
  CalibrationProblem problem(assembly, settings);
  search(problem);
  EXPECT_EQ(recording.lines.front().index, 40u);
  EXPECT_EQ(recording.lines.back().index, 44u);
  EXPECT_GE(problem.best().index, 40u);
  EXPECT_EQ(problem.stop_reason(), search::StopReason::max_evaluations) << "the budget is the stage's own";
}

}  // namespace
}  // namespace tunica
