// SPDX-License-Identifier: Apache-2.0
#include "search/early_end.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "calibration/recording.hpp"
#include "search/neighbours.hpp"

namespace tunica {
namespace {

using fakes::Bench;
using fakes::Line;
using fakes::Recording;
using search::CalibrationProblem;
using search::EarlyEnd;

/// Batches of random bounds and objectives above them: what is simulated includes the lowest, in any case.
TEST(EarlyEnd, TheLowestAreAlwaysAmongTheSimulated) {
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  EarlyEnd early;
  std::size_t simulated = 0, points = 0;
  for (int batch = 0; batch < 500; ++batch) {
    const std::size_t count = 1 + generator() % 60, best = 1 + generator() % 20;
    std::vector<double> bounds(count), objectives(count);
    early.clear();
    for (std::size_t k = 0; k < count; ++k) {
      bounds[k] = std::floor(20 * uniform(generator)) / 20;  // with equal ones
      objectives[k] = bounds[k] + 0.2 * std::floor(3 * uniform(generator));
      early.add(k, bounds[k]);
    }
    std::vector<double> known(count, std::nan(""));
    early.begin(best);
    // As on several threads: so many simulations at a time, which end in any order.
    const std::size_t threads = 1 + static_cast<std::size_t>(batch) % 4;
    std::vector<EarlyEnd::Taken> under_way;
    for (;;) {
      while (under_way.size() < threads) {
        const auto taken = early.take();
        if (!taken) break;
        EXPECT_TRUE(std::isnan(known[taken->point])) << "simulated twice";
        known[taken->point] = objectives[taken->point];
        under_way.push_back(*taken);
      }
      if (under_way.empty()) break;
      const auto ended = under_way.begin() + static_cast<std::ptrdiff_t>(generator() % under_way.size());
      early.found(*ended, objectives[ended->point]);
      under_way.erase(ended);
    }
    const auto left = early.left();
    if (threads == 1) {
      EXPECT_EQ(early.needless(), 0u);
    }
    for (std::size_t k = 0; k < left.size(); ++k) {
      EXPECT_EQ(std::isnan(known[left[k]]), k >= early.needless());
      known[left[k]] = bounds[left[k]];
      points += 1;
    }
    // By the rule itself, one point after the other: every bound within the best-th lowest objective before it.
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return bounds[a] < bounds[b]; });
    std::size_t needed = 0;
    for (std::vector<double> before; needed < count; ++needed) {
      std::sort(before.begin(), before.end());
      if (before.size() >= best && bounds[order[needed]] > before[best - 1]) break;
      before.push_back(objectives[order[needed]]);
    }
    EXPECT_EQ(count - left.size(), needed);
    simulated += count - left.size();
    // Ranks of the lowest as if all were simulated; of equals the first comes first.
    const auto ranks = [&](const std::vector<double>& values) {
      std::vector<std::size_t> by_value(count);
      std::iota(by_value.begin(), by_value.end(), std::size_t{0});
      std::stable_sort(by_value.begin(), by_value.end(),
                       [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
      by_value.resize(std::min(best, count));
      return by_value;
    };
    EXPECT_EQ(ranks(known), ranks(objectives));
  }
  EXPECT_GT(points, 0u);
  EXPECT_GT(simulated, 0u);
}

/// A costly test of three rows and a cheap one of five. The cheap one decides most of the ranks.
class EarlyEndOfEvaluations : public testing::Test {
 protected:
  static constexpr std::size_t batch = 12, best = 3, batches = 6;

  EarlyEndOfEvaluations() {
    bench_.add_test("slow", {0, 1, 2}, {3, 4, 6}).type = "costly_curve";
    bench_.add_test("quick", {0, 1, 2, 3, 4}, {3, 4, 5, 6, 7});
    fakes::set_behaviour([this](double a, std::span<double> values, Status& status) {
      if (values.size() != 3) return;
      ++simulations_;
      std::this_thread::sleep_for(takes_);
      if (a > fails_above_) status = Status::failed("the simulation broke down");
    });
  }
  struct Outcome {
    std::vector<Line> lines;
    std::vector<std::vector<std::size_t>> ranks;  ///< of each batch, the best
    search::Best found;
    search::Tally tally;
    int simulations;
  };
  Outcome run(bool early, unsigned threads = 1, const search::Replay& replay = {},
              experiment::OnFailure on_failure = experiment::OnFailure::penalise) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const assembly::Assembly assembly = bench_.assemble();
    Recording recording;
    CalibrationProblem::Settings settings;
    settings.record = recording.recorder();
    settings.skip_costly = true;
    settings.end_early = early;
    settings.replay = replay;
    settings.on_failure = on_failure;
    settings.stop.max_time = max_time_;
    settings.stop.target = target_;
    settings.interrupted = [this] { return simulations_ >= ends_after_; };
    CalibrationProblem problem(assembly, std::move(settings));
    std::mt19937_64 generator(seed_);
    std::uniform_real_distribution<double> uniform(0, 1);
    simulations_ = 0;
    Outcome outcome;
    for (std::size_t b = 0; b < batches; ++b) {
      std::vector<double> xs(batch * problem.dimension()), objectives(batch);
      for (double& x : xs) x = uniform(generator);
      std::vector<Status> statuses(batch);
      problem.evaluate_best(xs, best, objectives, statuses);
      std::vector<std::size_t> order;
      for (std::size_t k = 0; k < batch; ++k)
        if (statuses[k].ok()) order.push_back(k);
      std::stable_sort(order.begin(), order.end(),
                       [&](std::size_t one, std::size_t other) { return objectives[one] < objectives[other]; });
      order.resize(std::min(best, order.size()));
      outcome.ranks.push_back(order);
    }
    outcome.lines = recording.lines;
    outcome.found = problem.best();
    outcome.tally = problem.tally();
    outcome.simulations = simulations_;
    return outcome;
  }
  Bench bench_;
  std::atomic<int> simulations_ = 0;
  double fails_above_ = 1e300;
  int ends_after_ = 1'000'000;  ///< simulations, after which a person ends the work
  std::chrono::milliseconds takes_{0};
  std::optional<double> max_time_, target_;
  std::uint64_t seed_ = 3;  ///< of the points
};

/// An offspring that ended early is not evaluated: neither it nor what was best before it has reached anything.
TEST_F(EarlyEndOfEvaluations, ATargetIsReachedBySimulatedPointsOnly) {
  while (!run(true).lines.front().ended_early) ASSERT_LT(++seed_, 50u);  // nothing is known before it
  const Outcome all = run(false);
  target_ = 0.999 * all.found.objective;
  EXPECT_EQ(run(true).lines.size(), batches * batch);
  target_ = all.found.objective;
  const Outcome reached = run(false), early = run(true);
  EXPECT_LT(reached.lines.size(), batches * batch);
  EXPECT_EQ(early.lines.size(), reached.lines.size());
  EXPECT_EQ(early.found.index, reached.found.index);
}

TEST_F(EarlyEndOfEvaluations, RanksAndBestPointStayTheSame) {
  const Outcome all = run(false), early = run(true);
  EXPECT_EQ(early.ranks, all.ranks);
  EXPECT_EQ(early.found.parameters, all.found.parameters);
  EXPECT_EQ(early.found.objective, all.found.objective);
  EXPECT_EQ(early.found.index, all.found.index);
  EXPECT_EQ(early.tally.evaluations, all.tally.evaluations);
  EXPECT_EQ(all.simulations, static_cast<int>(batches * batch));
  EXPECT_LT(early.simulations, all.simulations / 2);
  EXPECT_EQ(early.tally.simulated, static_cast<std::uint64_t>(early.simulations));
  EXPECT_EQ(early.tally.simulated + early.tally.ended_early, batches * batch);
  for (const Line& line : early.lines) {
    EXPECT_EQ(std::isnan(line.per_test[0]), line.ended_early);
    const Line& whole = all.lines[line.index];
    EXPECT_EQ(line.per_test[1], whole.per_test[1]);
    if (line.ended_early) {
      EXPECT_EQ(line.objective, line.per_test[1]);
      EXPECT_LE(line.objective, whole.objective);
    } else {
      EXPECT_EQ(line.objective, whole.objective);
    }
  }
}

TEST_F(EarlyEndOfEvaluations, FailedSimulationsDoNotChangeTheRanks) {
  fails_above_ = 4;
  const Outcome all = run(false), early = run(true);
  EXPECT_EQ(early.ranks, all.ranks);
  EXPECT_EQ(early.found.parameters, all.found.parameters);
  EXPECT_GT(early.tally.failures, 0u);
}

TEST_F(EarlyEndOfEvaluations, ThreadsDoNotMatter) {
  const Outcome one = run(true, 1), two = run(true, 2), four = run(true, 4);
  EXPECT_EQ(one.lines, two.lines);
  EXPECT_EQ(one.lines, four.lines);
  EXPECT_EQ(one.tally.simulated, four.tally.simulated);
  EXPECT_EQ(one.simulations, static_cast<int>(one.tally.simulated));  // one thread has nothing to be ahead of
  EXPECT_GE(four.simulations, one.simulations);
}

TEST_F(EarlyEndOfEvaluations, AJournalCutAnywhereIsContinuedToTheSameRows) {
  const Outcome whole = run(true);
  Recording recording{whole.lines};
  for (std::size_t rows = 0; rows <= whole.lines.size(); ++rows) {
    const Outcome resumed = run(true, 1, recording.replay(rows));
    ASSERT_EQ(resumed.lines, whole.lines) << rows;
    EXPECT_EQ(resumed.tally.simulated, whole.tally.simulated);
    EXPECT_LE(resumed.simulations, whole.simulations);
  }
  EXPECT_EQ(run(true, 1, recording.replay(whole.lines.size())).simulations, 0);
}

TEST_F(EarlyEndOfEvaluations, WhatAPersonEndsAnywhereIsContinuedToTheSameRows) {
  const Outcome whole = run(true);
  for (const unsigned threads : {1, 2})
    for (int simulations = 1; simulations < whole.simulations; ++simulations) {
      ends_after_ = simulations;
      const Recording ended{run(true, threads).lines};
      ends_after_ = 1'000'000;
      // Two threads may both be in their last simulation.
      ASSERT_LE(ended.lines.size() + (threads == 1 ? 1 : 0), whole.lines.size()) << simulations;
      EXPECT_TRUE(std::equal(ended.lines.begin(), ended.lines.end(), whole.lines.begin())) << simulations;
      EXPECT_EQ(run(true, threads, ended.replay(ended.lines.size())).lines, whole.lines) << simulations;
    }
}

TEST_F(EarlyEndOfEvaluations, PointsThatTimeLeavesNoSimulationForHaveTheirBound) {
  const Outcome whole = run(true);
  takes_ = std::chrono::milliseconds(20);
  max_time_ = 0.03;
  const Outcome early = run(true);
  EXPECT_LE(early.simulations, 2);  // none begins after its time
  EXPECT_EQ(early.tally.simulated, static_cast<std::uint64_t>(early.simulations));
  ASSERT_LE(early.lines.size(), batch);
  for (const Line& line : early.lines) {
    if (line.ended_early) {
      EXPECT_EQ(line.objective, line.per_test[1]);
    } else {
      EXPECT_EQ(line, whole.lines[line.index]);
    }
  }
}

TEST_F(EarlyEndOfEvaluations, PoliciesThatLookAtFailuresSimulateEverything) {
  for (const auto policy : {experiment::OnFailure::stop, experiment::OnFailure::retry})
    EXPECT_EQ(run(true, 1, {}, policy).simulations, static_cast<int>(batches * batch));
}

/// The neighbourhood asks for the lowest neighbour alone. At the optimum of both tests, the quick one alone puts the
/// far neighbours above the near ones.
TEST_F(EarlyEndOfEvaluations, TheNeighbourhoodSimulatesWhatMayBeTheLowest) {
  const std::vector<double> x{0, 1, 2}, y{3, 4, 5}, more{0, 1, 2, 3, 4}, values{3, 4, 5, 6, 7}, free{3, 1, 0};
  Bench costly, cheap;  // the same, and nothing costly
  costly.add_test("slow", x, y).type = "costly_curve";
  cheap.add_test("slow", x, y);
  for (Bench* bench : {&costly, &cheap}) bench->add_test("quick", more, values);
  const auto fewer = search::probe_neighbourhood(costly.assemble(), free);
  const auto all = search::probe_neighbourhood(cheap.assemble(), free);
  ASSERT_TRUE(fewer.lowest && all.lowest);
  EXPECT_EQ(fewer.lowest->parameters, all.lowest->parameters);
  EXPECT_NEAR(fewer.lowest->objective, all.lowest->objective, 1e-15);
  EXPECT_EQ(fewer.better, all.better);
  EXPECT_EQ(fewer.evaluated, all.evaluated);
  EXPECT_EQ(all.simulated, all.evaluated);
  EXPECT_LT(fewer.simulated, fewer.evaluated / 2);
}

/// A deadline that is past when the neighbourhood is asked for: the point is evaluated, no neighbour is, and both are
/// counted.
TEST_F(EarlyEndOfEvaluations, TheNeighbourhoodLeavesOutWhatTimeIsOverFor) {
  const std::vector<double> x{0, 1, 2}, y{3, 4, 5}, free{3, 1, 0};
  for (const char* type : {"curve", "costly_curve"}) {
    Bench bench;
    bench.add_test("one", x, y).type = type;
    const auto all = search::probe_neighbourhood(bench.assemble(), free);
    const auto late = search::probe_neighbourhood(bench.assemble(), free, plugins::Clock::now());
    EXPECT_TRUE(late.status.ok());
    EXPECT_EQ(late.objective, all.objective);
    EXPECT_EQ(all.left_out, 0U);
    EXPECT_GT(all.evaluated, 0U);
    EXPECT_EQ(late.evaluated + late.failed, 0U);
    EXPECT_GT(late.left_out, 0U);
    EXPECT_FALSE(late.lowest || late.better);
  }
}

}  // namespace
}  // namespace tunica
