// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "search/correction.hpp"
#include "search/stop_reason.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::search {

/// One evaluation as it goes to evaluations.csv, in the order of its index.
struct Record {
  std::uint64_t index;                 ///< within the realisation, from 0
  std::span<const double> parameters;  ///< free values in base units
  double objective;                    ///< undefined when failed
  std::span<const double> per_test;
  const Status& status;
  double seconds;            ///< since the realisation began
  bool ended_early = false;  ///< the objective is a lower bound, see Problem::evaluate_best
};

/// Whether one point is strictly better than another: a smaller violation, or at equal violations a smaller objective.
inline bool is_better(double objective, double violation, double than_objective, double than_violation) {
  return violation != than_violation ? violation < than_violation : objective < than_objective;
}

/// The best point so far: the feasible one with the smallest objective, or the one with the smallest violation while
/// none is feasible.
struct Best {
  std::vector<double> parameters;  ///< empty: nothing succeeded yet
  double objective = 0;
  std::uint64_t index = 0;
  double violation = 0;  ///< > 0: infeasible

  [[nodiscard]] bool found() const { return !parameters.empty(); }
  [[nodiscard]] bool feasible() const { return found() && violation == 0; }
  /// Strictly better than another. The first of equal points therefore stays.
  [[nodiscard]] bool better_than(const Best& other) const {
    if (!found() || !other.found()) return found() && !other.found();
    return is_better(objective, violation, other.objective, other.violation);
  }
};

/// A journal of earlier evaluations in index order, for resuming. It returns false if it has no entry at this index,
/// and then has none at a later index either. The problem checks that the parameters are bit-identical, and throws
/// std::runtime_error otherwise. If residuals are requested, it evaluates again and checks the objective instead. It is
/// called from one thread at a time, possibly twice for one index.
struct JournalEntry {
  std::vector<double> parameters, per_test;
  double objective;
  Status status;
  double seconds;
  bool ended_early = false;
};
using Replay = std::function<bool(std::uint64_t index, JournalEntry& entry)>;

/// Failures whose reasons differ only in numbers.
struct FailureKind {
  std::string example;  ///< the first of them
  std::uint64_t count = 0;
};

/// Local searches that ended with a parameter at one of its bounds.
struct BoundStops {
  std::size_t parameter = 0;
  bool upper = false;
  std::uint64_t count = 0;
  double objective = 0;  ///< the least of them
};

struct Tally {
  std::uint64_t evaluations = 0, jacobians = 0, failures = 0, infeasible = 0;
  std::uint64_t ended_early = 0;  ///< of the evaluations, see Problem::evaluate_best
  std::uint64_t simulated = 0;    ///< evaluations for which costly tests were simulated, those that failed included
  std::uint64_t guide_evaluations = 0;    ///< of the tests that stand in, counted beside; see guided.hpp
  std::string first_failure = {};         ///< reason of the first failed evaluation
  std::vector<FailureKind> reasons = {};  ///< in order of appearance, the first `most_reasons`
  static constexpr std::size_t most_reasons = 20;
  std::uint64_t starts = 0;  ///< local searches that came to a point
  std::vector<BoundStops> bound_stops = {};

  /// A local search has ended at this point of the unit box.
  void add_start(std::span<const double> x, double objective);
  void add_stops(const BoundStops& stops);

  void add_failure(const std::string& reason, std::uint64_t count = 1);
  void add(const Tally& part);
};

/// The host's Problem. It counts evaluations, keeps the best, enforces the stop block and the failure policy, records
/// every evaluation in index order, and replays a journal. There is one object per realisation and stage;
/// stop.max_evaluations and stop.stall count only its evaluations.
///
/// A batch counts as a whole, up to the budget. If it meets the target or stalls within a batch, the search refuses
/// only later batches, so results do not depend on threads. Starts run in parallel and are merged in order
/// (starts.hpp). A start has its own evaluations() and budget(), from the budget that remained when its block began.
/// Only max_time and an interruption depend on the clock. The record is then a prefix of the full record, except for
/// the last batch before max_time: points that were not simulated in it count as ended early.
class CalibrationProblem : public Problem {
 public:
  struct Settings {
    experiment::Stop stop;
    experiment::OnFailure on_failure = experiment::OnFailure::penalise;
    double max_failure_rate = 1;
    std::uint64_t seed = 0;     ///< of the realisation
    std::vector<double> start;  ///< unit box; empty = the parameters' initial values
    /// If set, the second and later independent searches begin at points that depend only on this number. start() of
    /// their problems returns that point.
    std::optional<std::uint64_t> paired_starts = {};
    std::function<void(const Record&)> record = {};  ///< called in index order, never concurrently
    Replay replay = {};
    std::function<bool()> interrupted = {};  ///< Ctrl-C; called from any thread
    std::uint64_t first_index = 0;           ///< of a later stage
    double elapsed_before = 0;               ///< s, counted against max_time
    bool skip_costly = false;                ///< at infeasible points, see CostlyTests
    const Correction* correction = nullptr;  ///< of the residuals, and the part of the box that is searched
    bool end_early = false;                  ///< evaluations in evaluate_best() if cheap tests decide them
  };
  CalibrationProblem(const assembly::Assembly& assembly, Settings settings);
  ~CalibrationProblem() override;

  [[nodiscard]] const Best& best() const;
  [[nodiscard]] const Tally& tally() const;
  [[nodiscard]] StopReason stop_reason() const;            ///< none: no rule of the stop block ended it
  [[nodiscard]] const std::string& stop_sentence() const;  ///< the same as a sentence; empty for none

  // Problem
  [[nodiscard]] std::size_t dimension() const override;
  [[nodiscard]] std::span<const double> start() const override;
  [[nodiscard]] std::span<const ResidualBlock> blocks() const override;
  [[nodiscard]] std::size_t residual_count() const override;
  [[nodiscard]] std::size_t constraint_count() const override;
  Status evaluate(std::span<const double> x, double& objective) override;
  void evaluate_batch(std::span<const double> xs, std::span<double> objectives, std::span<Status> statuses) override;
  void evaluate_best(std::span<const double> xs, std::size_t best, std::span<double> objectives,
                     std::span<Status> statuses) override;
  Status linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                   std::span<double> jacobian) override;
  Status constraints(std::span<const double> x, std::span<double> values, std::span<double> jacobian) override;
  std::size_t for_each_start(std::size_t count, const std::function<void(std::size_t, Problem&)>& body) override;
  [[nodiscard]] bool should_stop() const override;
  [[nodiscard]] std::uint64_t evaluations() const override;
  [[nodiscard]] std::uint64_t budget() const override;
  [[nodiscard]] std::uint64_t seed(std::string_view purpose) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tunica::search
