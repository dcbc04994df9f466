// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "calibration/recording.hpp"
#include "search/calibration_problem.hpp"
#include "tunica/random.hpp"

namespace tunica {
namespace {

using assembly::Assembly;
using fakes::Bench;
using fakes::Line;
using fakes::Recording;
using search::CalibrationProblem;
using testing::HasSubstr;
using namespace std::chrono_literals;

/// y = 1 + x measured; the objective at (a, b, c) has its zero at (1, 1, 0).
class ProblemOnALine : public testing::Test {
 protected:
  ProblemOnALine() {
    bench_.add_test("t", fakes::grid(0, 2, 9), fakes::map(fakes::grid(0, 2, 9), [](double x) { return 1 + x; }));
  }
  CalibrationProblem::Settings settings(std::uint64_t max_evaluations = 1000) {
    CalibrationProblem::Settings s;
    s.stop.max_evaluations = max_evaluations;
    s.record = recording_.recorder();
    return s;
  }
  Bench bench_;
  Recording recording_;
};

TEST_F(ProblemOnALine, CountsRecordsAndKeepsTheFirstOfEqualBests) {
  const Assembly assembly = bench_.assemble();
  CalibrationProblem problem(assembly, settings());
  EXPECT_EQ(problem.dimension(), 3u);
  EXPECT_NEAR(problem.start()[1], 0.5, 1e-15);
  double objective = 0;
  for (const double a : {0.3, 0.1, 0.2, 0.1}) {
    EXPECT_TRUE(problem.evaluate(std::vector<double>{a, 0.5, 0.5}, objective).ok());
  }
  EXPECT_EQ(problem.evaluations(), 4u);
  EXPECT_EQ(problem.budget(), 996u);
  EXPECT_EQ(problem.best().index, 1u);
  EXPECT_NEAR(problem.best().parameters[0], 1, 1e-15);
  ASSERT_EQ(recording_.lines.size(), 4u);
  EXPECT_EQ(recording_.lines[2].index, 2u);
  EXPECT_NEAR(recording_.lines[2].parameters[0], 2, 1e-15);
  EXPECT_EQ(recording_.lines[2].objective, recording_.lines[2].per_test[0]);
}

TEST_F(ProblemOnALine, RefusesEverythingAfterTheBudgetWithoutCounting) {
  const Assembly assembly = bench_.assemble();
  CalibrationProblem problem(assembly, settings(5));
  std::vector<double> xs(8 * 3, 0.5), objectives(8, -1);
  std::vector<Status> statuses(8);
  problem.evaluate_batch(xs, objectives, statuses);
  EXPECT_TRUE(problem.should_stop());
  EXPECT_EQ(problem.stop_reason(), search::StopReason::max_evaluations);
  EXPECT_EQ(problem.evaluations(), 5u);
  EXPECT_EQ(problem.budget(), 0u);
  EXPECT_TRUE(statuses[4].ok());
  EXPECT_EQ(statuses[5].reason(), "stopped: max_evaluations");
  EXPECT_EQ(objectives[5], -1);
  double objective = -1;
  EXPECT_EQ(problem.evaluate(std::vector<double>{0.5, 0.5, 0.5}, objective).kind(), Status::Kind::failed);
  EXPECT_EQ(objective, -1);
  std::vector<double> residuals(9);
  EXPECT_EQ(problem.linearise(std::vector<double>{0.5, 0.5, 0.5}, objective, residuals, {}).reason(),
            "stopped: max_evaluations");
  EXPECT_EQ(problem.evaluations(), 5u);
  EXPECT_EQ(recording_.lines.size(), 5u);
}

TEST_F(ProblemOnALine, StopsAtItsTarget) {
  const Assembly assembly = bench_.assemble();
  auto s = settings();
  s.stop.target = 1e-12;
  CalibrationProblem problem(assembly, s);
  double objective = 0;
  EXPECT_TRUE(problem.evaluate(std::vector<double>{0.3, 0.5, 0.5}, objective).ok());
  EXPECT_FALSE(problem.should_stop());
  EXPECT_TRUE(problem.evaluate(std::vector<double>{0.1, 0.5, 0.5}, objective).ok());
  EXPECT_TRUE(problem.should_stop());
  EXPECT_EQ(problem.stop_reason(), search::StopReason::target);
}

TEST_F(ProblemOnALine, StopsWhenItStalls) {
  const Assembly assembly = bench_.assemble();
  auto s = settings();
  s.stop.stall = 3;
  CalibrationProblem problem(assembly, s);
  double objective = 0;
  for (const double a : {0.5, 0.4, 0.6, 0.3, 0.3, 0.3, 0.3}) {
    static_cast<void>(problem.evaluate(std::vector<double>{a, 0.5, 0.5}, objective));
  }
  EXPECT_EQ(problem.stop_reason(), search::StopReason::stall);
  EXPECT_EQ(problem.evaluations(), 7u);
  EXPECT_EQ(problem.best().index, 3u);
}

TEST_F(ProblemOnALine, StopsOnTheClockAndOnRequest) {
  const Assembly assembly = bench_.assemble();
  auto s = settings();
  s.stop.max_time = 5;
  s.elapsed_before = 6;
  EXPECT_TRUE(CalibrationProblem(assembly, s).should_stop());
  std::atomic<bool> pressed = false;
  s.elapsed_before = 0;
  s.interrupted = [&] { return pressed.load(); };
  CalibrationProblem problem(assembly, s);
  EXPECT_FALSE(problem.should_stop());
  pressed = true;
  EXPECT_TRUE(problem.should_stop());
  EXPECT_EQ(problem.stop_reason(), search::StopReason::interrupted);
}

/// A batch that ends before its last point: what is known of it is counted, in order, and the rest is refused.
void expect_a_part(const CalibrationProblem& problem, const Recording& recording, const std::vector<Status>& statuses) {
  const std::size_t known = problem.evaluations();
  ASSERT_LT(known, statuses.size());
  EXPECT_EQ(recording.lines.size(), known);
  for (std::size_t k = 0; k < statuses.size(); ++k) EXPECT_EQ(statuses[k].ok(), k < known) << k;
  EXPECT_THAT(statuses.back().reason(), HasSubstr("stopped"));
}

TEST_F(ProblemOnALine, EndsABatchWhereItsTimeIsUp) {
  const Assembly assembly = bench_.assemble();
  fakes::set_behaviour([](double, std::span<double>, Status&) { std::this_thread::sleep_for(20ms); });
  const std::vector<double> xs(60, 0.5);
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Recording recording;
    auto s = settings();
    s.record = recording.recorder();
    s.stop.max_time = 0.1;
    CalibrationProblem problem(assembly, s);
    std::vector<double> objectives(20);
    std::vector<Status> statuses(20);
    problem.evaluate_batch(xs, objectives, statuses);
    expect_a_part(problem, recording, statuses);
    EXPECT_LE(problem.evaluations(), 5 * threads) << "none begins after its time";
    EXPECT_EQ(problem.stop_reason(), search::StopReason::max_time);
  }
}

TEST_F(ProblemOnALine, EndsABatchWhereAPersonDoes) {
  const Assembly assembly = bench_.assemble();
  std::atomic<int> calls = 0;
  fakes::set_behaviour([&](double, std::span<double>, Status&) { ++calls; });
  const std::vector<double> xs(60, 0.5);
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    calls = 0;
    Recording recording;
    auto s = settings();
    s.record = recording.recorder();
    s.interrupted = [&] { return calls >= 7; };
    CalibrationProblem problem(assembly, s);
    std::vector<double> objectives(20);
    std::vector<Status> statuses(20);
    problem.evaluate_batch(xs, objectives, statuses);
    expect_a_part(problem, recording, statuses);
    EXPECT_LE(problem.evaluations(), 7 + threads);
    EXPECT_EQ(problem.stop_reason(), search::StopReason::interrupted);
  }
}

TEST_F(ProblemOnALine, LinearisesInTheUnitBox) {
  const Assembly assembly = bench_.assemble();
  CalibrationProblem problem(assembly, settings());
  const std::vector<double> x{0.3, 0.6, 0.4};
  std::vector<double> residuals(9), jacobian(27), up(9), down(9);
  double objective = 0;
  ASSERT_TRUE(problem.linearise(x, objective, residuals, jacobian).ok());
  EXPECT_EQ(problem.tally().jacobians, 1u);
  for (std::size_t j = 0; j < 3; ++j) {
    std::vector<double> moved = x;
    moved[j] += 1e-5;
    ASSERT_TRUE(problem.linearise(moved, objective, up, {}).ok());
    moved[j] -= 2e-5;
    ASSERT_TRUE(problem.linearise(moved, objective, down, {}).ok());
    for (std::size_t i = 0; i < 9; ++i) {
      const double difference = (up[i] - down[i]) / 2e-5;
      EXPECT_NEAR(jacobian[i * 3 + j], difference, 1e-7 * (1 + std::abs(difference))) << i << " by " << j;
    }
  }
  EXPECT_EQ(problem.tally().jacobians, 1u);
  EXPECT_EQ(problem.evaluations(), 7u);
}

TEST_F(ProblemOnALine, ChecksWhatAnOptimiserAsksFor) {
  const Assembly assembly = bench_.assemble();
  CalibrationProblem problem(assembly, settings());
  double objective = 0;
  EXPECT_THAT(problem.evaluate(std::vector<double>{0.5, 1.5, 0.5}, objective).reason(),
              HasSubstr("coordinate 1 = 1.5, outside the unit box"));
  EXPECT_THAT(problem.evaluate(std::vector<double>{0.5, 0.5, std::nan("")}, objective).reason(),
              HasSubstr("coordinate 2 = nan"));
  EXPECT_EQ(problem.tally().failures, 2u);
  EXPECT_THAT(fakes::message_of([&] { static_cast<void>(problem.evaluate(std::vector<double>{0.5}, objective)); }),
              HasSubstr("1 coordinates where the problem has 3"));
}

TEST_F(ProblemOnALine, GivesSeedsByPurpose) {
  const Assembly assembly = bench_.assemble();
  auto s = settings();
  s.seed = 7;
  CalibrationProblem problem(assembly, s);
  EXPECT_EQ(problem.seed("sampling"), derive_seed(7, "sampling"));
  problem.for_each_start(2, [&](std::size_t k, Problem& child) {
    EXPECT_EQ(child.seed("x"), derive_seed(derive_seed(7, "start " + std::to_string(k)), "x"));
  });
}

TEST_F(ProblemOnALine, GivesTheSameRecordsForAnyNumberOfThreads) {
  const Assembly assembly = bench_.assemble();
  // Points of a fixed generator (seed 3); nothing here depends on which ones.
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> xs(500 * 3), objectives(500);
  for (double& x : xs) x = uniform(generator);
  fakes::set_behaviour([](double a, std::span<double>, Status& status) {
    if (a > 9) status = Status::failed("a is too large");
  });
  std::vector<std::vector<Line>> found;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Recording recording;
    auto s = settings(450);
    s.record = recording.recorder();
    CalibrationProblem problem(assembly, s);
    std::vector<Status> statuses(500);
    problem.evaluate_batch(xs, objectives, statuses);
    EXPECT_GT(problem.tally().failures, 0u);
    found.push_back(recording.lines);
  }
  EXPECT_EQ(found[0].size(), 450u);
  EXPECT_EQ(found[0], found[1]);
  EXPECT_EQ(found[0], found[2]);
}

TEST_F(ProblemOnALine, RefusesARunWithNothingToDo) {
  for (const char* name : {"a", "b", "c"}) bench_.parameter(name).fixed = 1;
  EXPECT_THAT(fakes::message_of([&] { CalibrationProblem(bench_.assemble(), settings()); }),
              HasSubstr("every parameter is fixed"));
  Bench held;
  held.add_test("t", {0, 1, 2}, {1, 2, 3}).hold_out.all = true;
  EXPECT_THAT(fakes::message_of([&] { CalibrationProblem(held.assemble(), settings()); }),
              HasSubstr("every row is held out"));
}

TEST_F(ProblemOnALine, CountsFailuresByReasonWhateverTheNumbersInThem) {
  fakes::set_behaviour([](double a, std::span<double>, Status& status) {
    status = a > 5 ? Status::failed("no root at row " + std::to_string(a * 1000)) : Status::failed("overflow");
  });
  const Assembly assembly = bench_.assemble();
  CalibrationProblem problem(assembly, settings());
  double objective = 0;
  static_cast<void>(problem.evaluate(std::vector{0.1, 0.5, 0.5}, objective));
  for (int k = 0; k < 3; ++k) static_cast<void>(problem.evaluate(std::vector{0.7 + 0.05 * k, 0.5, 0.5}, objective));
  const auto& reasons = problem.tally().reasons;
  ASSERT_EQ(reasons.size(), 2u);
  EXPECT_EQ(reasons[0].example, "test 't': overflow");
  EXPECT_EQ(reasons[0].count, 1u);
  EXPECT_THAT(reasons[1].example, HasSubstr("no root at row 7"));
  EXPECT_EQ(reasons[1].count, 3u);
}

TEST_F(ProblemOnALine, PenalisesStopsOrLimitsFailures) {
  fakes::set_behaviour([](double a, std::span<double>, Status& status) {
    if (a > 5) status = Status::failed("a is too large");
  });
  const Assembly assembly = bench_.assemble();
  const std::vector<double> good{0.3, 0.5, 0.5}, bad{0.7, 0.5, 0.5};
  double objective = 3;
  {
    CalibrationProblem problem(assembly, settings());
    EXPECT_EQ(problem.evaluate(bad, objective).kind(), Status::Kind::failed);
    EXPECT_EQ(objective, 3);
    EXPECT_FALSE(problem.should_stop());
    EXPECT_EQ(problem.tally().first_failure, "test 't': a is too large");
    EXPECT_TRUE(problem.best().parameters.empty());
  }
  {
    auto s = settings();
    s.on_failure = experiment::OnFailure::stop;
    CalibrationProblem problem(assembly, s);
    static_cast<void>(problem.evaluate(bad, objective));
    EXPECT_EQ(problem.stop_reason(), search::StopReason::failure);
    EXPECT_EQ(problem.stop_sentence(), "failure: test 't': a is too large");
  }
  {
    auto s = settings();
    s.max_failure_rate = 0.5;
    CalibrationProblem problem(assembly, s);
    for (int k = 0; k < 49; ++k) static_cast<void>(problem.evaluate(good, objective));
    for (int k = 0; k < 51; ++k) {
      EXPECT_FALSE(problem.should_stop());
      static_cast<void>(problem.evaluate(bad, objective));
    }
    EXPECT_EQ(problem.stop_reason(), search::StopReason::failure_rate);
    EXPECT_THAT(problem.stop_sentence(), HasSubstr("failure rate: 51 of 100 evaluations failed"));
  }
  {
    CalibrationProblem problem(assembly, settings());
    std::vector<double> xs, objectives(250);
    for (int k = 0; k < 250; ++k) xs.insert(xs.end(), bad.begin(), bad.end());
    std::vector<Status> statuses(250);
    problem.evaluate_batch(xs, objectives, statuses);
    EXPECT_EQ(problem.stop_reason(), search::StopReason::nothing_succeeded);
    EXPECT_THAT(
        problem.stop_sentence(),
        HasSubstr("nothing succeeded in the first 200 evaluations; the first failure: test 't': a is too large"));
  }
}

TEST(StopReason, IsFoundAgainByItsCode) {
  for (const auto& [reason, code] : search::stop_reason_codes) {
    EXPECT_EQ(search::code(reason), code);
    EXPECT_EQ(search::stop_reason_from_code(code), reason);
  }
  EXPECT_EQ(search::stop_reason_from_code("tired"), std::nullopt);
}

TEST_F(ProblemOnALine, RetriesFromTheNearestGoodPoint) {
  // A test that carries its solution from one call to the next and follows it only in steps of a below 3.
  double solved = 0;
  fakes::set_behaviour([&](double a, std::span<double>, Status& status) {
    if (std::abs(a - solved) > 3)
      status = Status::failed("too far from the last solution");
    else
      solved = a;
  });
  const Assembly assembly = bench_.assemble();
  auto s = settings();
  s.on_failure = experiment::OnFailure::retry;
  CalibrationProblem problem(assembly, s);
  double objective = 0;
  EXPECT_TRUE(problem.evaluate(std::vector<double>{0.2, 0.5, 0.5}, objective).ok());
  EXPECT_TRUE(problem.evaluate(std::vector<double>{0.7, 0.5, 0.5}, objective).ok()) << "5 in two steps of 2.5";
  EXPECT_EQ(problem.evaluations(), 2u);
  EXPECT_NEAR(recording_.lines[1].parameters[0], 7, 1e-12);
  solved = 100;
  const Status status = problem.evaluate(std::vector<double>{0.9, 0.5, 0.5}, objective);
  EXPECT_THAT(status.reason(), HasSubstr("steps from the nearest good point"));
  EXPECT_NEAR(recording_.lines[2].parameters[0], 9, 1e-12);
}

}  // namespace
}  // namespace tunica
