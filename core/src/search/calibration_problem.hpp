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

/// Whether one point is strictly better than another: the less violation, the less objective.
inline bool is_better(double objective, double violation, double than_objective, double than_violation) {
  return violation != than_violation ? violation < than_violation : objective < than_objective;
}

/// What the best evaluated point is, at any time: the feasible one of least objective; while none is feasible, the
/// one of least violation.
struct Best {
  std::vector<double> parameters;  ///< empty: nothing succeeded yet
  double objective = 0;
  std::uint64_t index = 0;
  double violation = 0;  ///< > 0: infeasible

  [[nodiscard]] bool found() const { return !parameters.empty(); }
  [[nodiscard]] bool feasible() const { return found() && violation == 0; }
  /// Strictly better than another, so that of equals the first stays.
  [[nodiscard]] bool better_than(const Best& other) const {
    if (!found() || !other.found()) return found() && !other.found();
    return is_better(objective, violation, other.objective, other.violation);
  }
};

/// A journal of evaluations that were already made, in index order, for resuming: returns false when it has none
/// at this index, and then never at a later one. The problem checks that the parameters are bit-identical and throws
/// std::runtime_error if not; where residuals are asked for it evaluates again and checks the objective instead.
/// Called from one thread at a time; an index may be asked for twice.
struct JournalEntry {
  std::vector<double> parameters, per_test;
  double objective;
  Status status;
  double seconds;
  bool ended_early = false;
};
using Replay = std::function<bool(std::uint64_t index, JournalEntry& entry)>;

/// Failures whose reasons differ in numbers only.
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

/// The host's Problem: counts, keeps the best, enforces the stop block and the failure policy, records every
/// evaluation in index order, replays a journal. One object per realisation and stage; stop.max_evaluations and
/// stop.stall count its own evaluations.
///
/// A batch counts whole, up to the budget: a target or a stall in the middle of one refuses what comes after it, so
/// that results do not depend on threads. Starts run side by side and are merged as if one after the other
/// (starts.hpp); a start's evaluations() and budget() are its own, from what was left when its block began. Only
/// max_time and an interruption depend on the clock. What is recorded then is a prefix of what would have been, but for
/// the last batch before max_time: what it did not come to simulate counts as ended early.
class CalibrationProblem : public Problem {
 public:
  struct Settings {
    experiment::Stop stop;
    experiment::OnFailure on_failure = experiment::OnFailure::penalise;
    double max_failure_rate = 1;
    std::uint64_t seed = 0;     ///< of the realisation
    std::vector<double> start;  ///< unit box; empty = the parameters' initial values
    /// Where given, the second and later of independent searches begin at points that depend on this number alone:
    /// their problems' start() is that point.
    std::optional<std::uint64_t> paired_starts = {};
    std::function<void(const Record&)> record = {};  ///< called in index order, never concurrently
    Replay replay = {};
    std::function<bool()> interrupted = {};  ///< Ctrl-C; called from any thread
    std::uint64_t first_index = 0;           ///< of a later stage
    double elapsed_before = 0;               ///< s, counted against max_time
    bool skip_costly = false;                ///< at infeasible points, see CostlyTests
    const Correction* correction = nullptr;  ///< of the residuals, and the part of the box that is searched
    bool end_early = false;                  ///< evaluations in evaluate_best() that cheap tests decide
  };
  CalibrationProblem(const assembly::Assembly& assembly, Settings settings);
  ~CalibrationProblem() override;

  [[nodiscard]] const Best& best() const;
  [[nodiscard]] const Tally& tally() const;
  [[nodiscard]] StopReason stop_reason() const;            ///< none: nothing of the stop block ended it
  [[nodiscard]] const std::string& stop_sentence() const;  ///< the same for people; empty for none

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
