// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <mutex>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "calibration/recording.hpp"
#include "search/calibration_problem.hpp"
#include "tunica/random.hpp"

namespace tunica {
namespace {

using fakes::Bench;
using fakes::Line;
using fakes::Recording;
using search::CalibrationProblem;
using testing::HasSubstr;

/// A search of its own: `steps` random points around the best so far, singly, in batches and with residuals. What it
/// does depends on what it is told, as an optimiser's steps do.
void wander(Problem& problem, int steps) {
  std::mt19937_64 generator(problem.seed("wander"));
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::size_t n = problem.dimension();
  std::vector<double> best(n, 0.5), residuals(problem.residual_count());
  double lowest = 1e300;
  for (int step = 0; step < steps && !problem.should_stop(); ++step) {
    std::vector<double> xs(4 * n), objectives(4, 1e300);
    for (std::size_t i = 0; i < xs.size(); ++i) xs[i] = 0.7 * best[i % n] + 0.3 * uniform(generator);
    std::vector<Status> statuses(4);
    problem.evaluate_batch(xs, objectives, statuses);
    if (step % 3 == 0) static_cast<void>(problem.evaluate(std::span(xs).first(n), objectives[0]));
    if (step % 5 == 0) static_cast<void>(problem.linearise(std::span(xs).first(n), objectives[0], residuals, {}));
    for (std::size_t k = 0; k < 4; ++k) {
      if (!(objectives[k] < lowest)) continue;
      lowest = objectives[k];
      best.assign(xs.begin() + static_cast<std::ptrdiff_t>(k * n),
                  xs.begin() + static_cast<std::ptrdiff_t>((k + 1) * n));
    }
  }
}

struct Outcome {
  std::vector<Line> lines;
  std::string reason;
  std::uint64_t evaluations, jacobians, failures, best;
  bool operator==(const Outcome&) const = default;
};

void PrintTo(const Outcome& outcome, std::ostream* out) {
  *out << outcome.lines.size() << " lines, stopped by '" << outcome.reason << "', best " << outcome.best;
}

class StartsOnALine : public testing::Test {
 protected:
  StartsOnALine() {
    bench_.add_test("t", fakes::grid(0, 2, 9), fakes::map(fakes::grid(0, 2, 9), [](double x) { return 1 + x; }));
    fakes::set_behaviour([](double a, std::span<double>, Status& status) {
      if (a > 7) status = Status::failed("a is too large");
    });
  }

  Outcome run(std::size_t threads, const experiment::Stop& stop, const search::Replay& replay = {}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const assembly::Assembly assembly = bench_.assemble();
    Recording recording;
    CalibrationProblem::Settings settings;
    settings.stop = stop;
    settings.seed = 11;
    settings.record = recording.recorder();
    settings.replay = replay;
    CalibrationProblem problem(assembly, settings);
    wander(problem, 2);
    problem.for_each_start(20, [](std::size_t k, Problem& child) { wander(child, 5 + static_cast<int>(k % 4) * 5); });
    wander(problem, 3);
    return {recording.lines,           problem.stop_sentence(),  problem.evaluations(),
            problem.tally().jacobians, problem.tally().failures, problem.best().index};
  }

  /// The plain loop that parallel starts must reproduce: one start after the other on one problem.
  Outcome one_after_the_other(const experiment::Stop& stop) {
    const assembly::Assembly assembly = bench_.assemble();
    Recording recording;
    CalibrationProblem::Settings settings;
    settings.stop = stop;
    settings.seed = 11;
    settings.record = recording.recorder();
    CalibrationProblem problem(assembly, settings);
    wander(problem, 2);
    for (std::size_t k = 0; k < 20 && !problem.should_stop(); ++k) {
      Seeded child(problem, derive_seed(11, "start " + std::to_string(k)));
      wander(child, 5 + static_cast<int>(k % 4) * 5);
    }
    wander(problem, 3);
    return {recording.lines,           problem.stop_sentence(),  problem.evaluations(),
            problem.tally().jacobians, problem.tally().failures, problem.best().index};
  }

  /// Passes everything on, with seeds of its own.
  class Seeded : public Problem {
   public:
    Seeded(Problem& inner, std::uint64_t seed) : inner_(inner), seed_(seed) {}
    [[nodiscard]] std::size_t dimension() const override { return inner_.dimension(); }
    [[nodiscard]] std::span<const double> start() const override { return inner_.start(); }
    [[nodiscard]] std::span<const ResidualBlock> blocks() const override { return inner_.blocks(); }
    [[nodiscard]] std::size_t residual_count() const override { return inner_.residual_count(); }
    [[nodiscard]] std::size_t constraint_count() const override { return 0; }
    Status evaluate(std::span<const double> x, double& objective) override { return inner_.evaluate(x, objective); }
    void evaluate_batch(std::span<const double> xs, std::span<double> objectives, std::span<Status> statuses) override {
      inner_.evaluate_batch(xs, objectives, statuses);
    }
    Status linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                     std::span<double> jacobian) override {
      return inner_.linearise(x, objective, residuals, jacobian);
    }
    Status constraints(std::span<const double>, std::span<double>, std::span<double>) override { return {}; }
    std::size_t for_each_start(std::size_t, const std::function<void(std::size_t, Problem&)>&) override { return 0; }
    [[nodiscard]] bool should_stop() const override { return inner_.should_stop(); }
    [[nodiscard]] std::uint64_t evaluations() const override { return inner_.evaluations(); }
    [[nodiscard]] std::uint64_t budget() const override { return inner_.budget(); }
    [[nodiscard]] std::uint64_t seed(std::string_view purpose) const override { return derive_seed(seed_, purpose); }

   private:
    Problem& inner_;
    std::uint64_t seed_;
  };

  Bench bench_;
};

experiment::Stop budget(std::uint64_t evaluations) { return {evaluations, {}, {}, {}}; }

TEST_F(StartsOnALine, AreWhatTheyWouldBeOneAfterTheOther) {
  const Outcome whole = one_after_the_other(budget(100000));
  EXPECT_EQ(whole.reason, "");
  EXPECT_GT(whole.failures, 0u);
  EXPECT_GT(whole.jacobians + whole.evaluations, 1000u);
  // Budgets that end before the starts, at several places within them, in the middle of a batch, and after them.
  for (const std::uint64_t evaluations : {3u, 9u, 10u, 57u, 203u, 777u, 100000u}) {
    const Outcome expected = one_after_the_other(budget(evaluations));
    EXPECT_EQ(expected.evaluations, std::min<std::uint64_t>(evaluations, whole.evaluations));
    for (const std::size_t threads : {1u, 2u, 4u})
      EXPECT_EQ(run(threads, budget(evaluations)), expected) << evaluations;
  }
}

TEST_F(StartsOnALine, StopAtTheTargetOfAllOfThem) {
  const std::vector<Line> whole = one_after_the_other(budget(100000)).lines;
  // Targets that the search reaches early, late and at its very best.
  double lowest = 1e300;
  std::set<double> improvements;
  for (const Line& line : whole) {
    if (line.kind == Status::Kind::ok && line.objective < lowest) improvements.insert(lowest = line.objective);
  }
  ASSERT_GT(improvements.size(), 4u);
  for (const double target : improvements) {
    experiment::Stop stop = budget(100000);
    stop.target = target;
    const Outcome expected = one_after_the_other(stop);
    EXPECT_EQ(expected.reason, "target");
    for (const std::size_t threads : {1u, 2u}) EXPECT_EQ(run(threads, stop), expected) << target;
  }
}

TEST_F(StartsOnALine, StallTogether) {
  for (const std::uint64_t stall : {5u, 20u, 100u, 300u}) {
    experiment::Stop stop = budget(100000);
    stop.stall = stall;
    const Outcome expected = one_after_the_other(stop);
    EXPECT_EQ(expected.reason, "stall");
    for (const std::size_t threads : {1u, 2u}) EXPECT_EQ(run(threads, stop), expected) << stall;
  }
}

TEST_F(StartsOnALine, ResumeFromAJournalThatEndsAnywhere) {
  const Outcome whole = run(2, budget(400));
  Recording recording;
  recording.lines = whole.lines;
  for (const std::size_t known : {1u, 8u, 9u, 11u, 60u, 201u, 399u, 400u}) {
    EXPECT_EQ(run(2, budget(400), recording.replay(known)), whole) << known;
  }
}

TEST_F(StartsOnALine, RefuseAJournalOfAnotherRun) {
  Recording recording;
  recording.lines = run(1, budget(400)).lines;
  recording.lines[150].parameters[2] += 1e-12;
  const std::string message = fakes::message_of([&] { run(1, budget(400), recording.replay(400)); });
  EXPECT_THAT(message, HasSubstr("evaluation 151 of the journal cannot be continued: c was"));
  EXPECT_THAT(message, HasSubstr("start anew without --resume"));
}

TEST_F(StartsOnALine, SeeTheSameBodiesRunForAnyNumberOfThreads) {
  std::vector<std::vector<std::size_t>> visited;
  for (const std::size_t threads : {1u, 2u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const assembly::Assembly assembly = bench_.assemble();
    CalibrationProblem::Settings settings;
    settings.stop = budget(100);
    CalibrationProblem problem(assembly, settings);
    std::vector<std::size_t> evaluations(100, 0);
    const std::size_t begun = problem.for_each_start(100, [&](std::size_t k, Problem& child) {
      EXPECT_EQ(child.budget(), 100u);
      wander(child, 10);
      evaluations[k] = child.evaluations();
    });
    EXPECT_EQ(problem.evaluations(), 100u);
    EXPECT_EQ(begun, 3u) << "of 46 evaluations each";
    EXPECT_EQ(evaluations[8], 0u) << "the second block does not begin";
    evaluations.resize(begun);
    visited.push_back(evaluations);
  }
  EXPECT_EQ(visited[0], visited[1]);
}

TEST_F(StartsOnALine, KeepAPrefixWhenInterrupted) {
  const Outcome whole = run(1, budget(100000));
  const assembly::Assembly assembly = bench_.assemble();
  Recording recording;
  std::atomic<int> looks = 0;
  CalibrationProblem::Settings settings;
  settings.stop = budget(100000);
  settings.seed = 11;
  settings.record = recording.recorder();
  settings.interrupted = [&] { return ++looks > 300; };
  CalibrationProblem problem(assembly, settings);
  wander(problem, 2);
  problem.for_each_start(20, [](std::size_t k, Problem& child) { wander(child, 5 + static_cast<int>(k % 4) * 5); });
  EXPECT_EQ(problem.stop_reason(), search::StopReason::interrupted);
  ASSERT_LT(recording.lines.size(), whole.lines.size());
  EXPECT_TRUE(std::equal(recording.lines.begin(), recording.lines.end(), whole.lines.begin()));
  EXPECT_GT(recording.lines.size(), 10u);
}

TEST_F(StartsOnALine, EndThoseUnderWayWhenAnEarlierOneEndsTheSearch) {
  constexpr std::uint64_t most = 1'000'000;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 2);
  const assembly::Assembly assembly = bench_.assemble();
  CalibrationProblem::Settings settings;
  settings.stop = budget(most);
  settings.stop.target = 1e9;  // any point will do
  CalibrationProblem problem(assembly, settings);
  std::uint64_t wasted = 0;
  const std::size_t begun = problem.for_each_start(2, [&](std::size_t k, Problem& child) {
    double objective = 0;
    if (k == 0) static_cast<void>(child.evaluate(std::vector<double>(child.dimension(), 0.5), objective));
    if (k == 0) return;
    // Its own target would end it as well; points that fail do not reach it.
    const std::vector<double> fails(child.dimension(), 1.0);
    for (; !child.should_stop(); ++wasted) static_cast<void>(child.evaluate(fails, objective));
  });
  EXPECT_EQ(problem.evaluations(), 1u);
  EXPECT_EQ(problem.stop_reason(), search::StopReason::target);
  EXPECT_EQ(begun, 1u);
  EXPECT_LT(wasted, most);
}

TEST_F(StartsOnALine, NestOneAfterTheOther) {
  const assembly::Assembly assembly = bench_.assemble();
  CalibrationProblem::Settings settings;
  settings.stop = budget(100000);
  CalibrationProblem problem(assembly, settings);
  std::mutex mutex;
  std::set<std::uint64_t> seeds;
  problem.for_each_start(3, [&](std::size_t, Problem& child) {
    child.for_each_start(2, [&](std::size_t, Problem& grandchild) {
      const std::lock_guard lock(mutex);
      seeds.insert(grandchild.seed("x"));
    });
  });
  EXPECT_EQ(seeds.size(), 6u);
}

TEST_F(StartsOnALine, PairedSearchesBeginAtPointsThatTheSeedOfAnOptimiserDoesNotChange) {
  const assembly::Assembly assembly = bench_.assemble();
  const auto begun = [&](std::uint64_t seed, std::optional<std::uint64_t> paired, std::size_t count) {
    CalibrationProblem::Settings settings;
    settings.seed = seed;
    settings.paired_starts = paired;
    CalibrationProblem problem(assembly, settings);
    std::vector<std::vector<double>> starts(count), later(count);
    const auto note = [](auto& into) {
      return [&into](std::size_t k, Problem& child) { into[k].assign(child.start().begin(), child.start().end()); };
    };
    problem.for_each_start(count, note(starts));
    problem.for_each_start(count, note(later));
    for (const auto& start : later)
      EXPECT_TRUE(std::ranges::equal(start, problem.start())) << "only the first searches begin anew";
    return starts;
  };
  const auto one = begun(11, 5, 4), other = begun(12, 5, 7), elsewhere = begun(11, 6, 4), free = begun(11, {}, 4);
  EXPECT_EQ(one[0], free[0]) << "the first begins at the initial values";
  EXPECT_EQ(free[3], free[0]);
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_EQ(one[k], other[k]) << k;
    EXPECT_NE(one[k], elsewhere[k]) << k;
    EXPECT_NE(one[k], one[k - 1]) << k;
  }
}

}  // namespace
}  // namespace tunica
