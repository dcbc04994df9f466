// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "assembly/secant.hpp"
#include "search/calibration_problem.hpp"
#include "search/continuation.hpp"
#include "search/early_end.hpp"
#include "search/ledger.hpp"

namespace tunica::search {

/// Seconds since the realisation began, those before a resume or an earlier stage included.
class Stopwatch {
 public:
  explicit Stopwatch(double before) : before_(before) {}
  [[nodiscard]] double seconds() const {
    return before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  /// A replayed evaluation was made at `seconds`. The watch never shows less.
  void catch_up(double seconds) {
    const double late = seconds - this->seconds();
    if (late > 0) before_ += late;
  }
  /// Adds the time that an earlier process lost in the call that ended it.
  void add(double seconds) { before_ += seconds; }
  /// The time at which it will show `seconds`.
  [[nodiscard]] std::chrono::steady_clock::time_point reaches(double seconds) const {
    using Clock = std::chrono::steady_clock;
    constexpr double far = 1e9;  // s; a clock that counts nanoseconds ends after 292 years
    const double left = std::min(seconds - before_, far);
    return start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(left));
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::atomic<double> before_;
};

/// Workspaces lent to threads. Each task borrows its own, even a task that a waiting thread takes meanwhile.
class WorkspacePool {
 public:
  explicit WorkspacePool(const assembly::Assembly& assembly) : assembly_(assembly) {}
  class Loan {
   public:
    explicit Loan(WorkspacePool& pool) : pool_(pool), workspace_(pool.take()) {}
    ~Loan() { pool_.give(std::move(workspace_)); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    assembly::Workspace& operator*() const { return *workspace_; }

   private:
    WorkspacePool& pool_;
    assembly::WorkspacePointer workspace_;
  };

 private:
  assembly::WorkspacePointer take();
  void give(assembly::WorkspacePointer workspace);

  const assembly::Assembly& assembly_;
  std::mutex mutex_;
  std::vector<assembly::WorkspacePointer> idle_;
};

/// The state that all searches of one realisation share.
struct SharedState {
  SharedState(const assembly::Assembly& assembly, const CalibrationProblem::Settings& settings);

  const assembly::Assembly& assembly;
  const CalibrationProblem::Settings& settings;
  const assembly::UnitBox box;  ///< that of the assembly, or the part of it that is searched
  std::size_t parameters, tests;
  std::vector<double> start;  ///< unit box
  Stopwatch watch;
  WorkspacePool pool;
  bool replaying;  ///< the journal has entries left; while true nothing runs in parallel
};

/// Evaluations in the order of requests, call by call; a call is a batch or a single point.
struct Evaluations {
  struct Call {
    std::size_t first, size;
    bool jacobian;
  };
  std::vector<Call> calls;
  std::vector<double> parameters, per_test, objectives, seconds;
  std::vector<Status> statuses;
  std::vector<char> ended_early;
  std::string contradiction;  ///< of the journal, at evaluation `contradicted`
  std::size_t contradicted = 0;

  [[nodiscard]] std::size_t size() const { return objectives.size(); }
  void grow(std::size_t count, bool jacobian, std::size_t parameter_count, std::size_t test_count);
  /// Shortens the last call; a call of length zero is removed.
  void cut_call(std::size_t size, std::size_t parameter_count, std::size_t test_count);
  void clear();
  /// Shortens to this many slots; calls stay.
  void resize(std::size_t slots, std::size_t parameter_count, std::size_t test_count);
  /// The part of the evaluation that was done at a slot, from the journal's entry.
  [[nodiscard]] Extent extent(std::size_t slot, std::size_t test_count) const;
};

/// A search through the unit box. It checks points, evaluates or replays them, counts them, and refuses points after
/// the stop. Evaluations stay in `made` until the caller takes them out. Batches count as a whole up to the budget: a
/// target or stall within a batch stops only later batches.
class Oracle {
 public:
  /// `replay_from`: index of the first evaluation in the journal; used only while it lasts.
  /// It also stops where `needless` becomes true.
  Oracle(SharedState& shared, Ledger ledger, std::optional<std::uint64_t> replay_from,
         const std::atomic<bool>* needless = nullptr);

  Status evaluate(std::span<const double> x, double& objective);
  void evaluate_batch(std::span<const double> xs, std::span<double> objectives, std::span<Status> statuses) {
    evaluate_best(xs, objectives.size(), objectives, statuses);
  }
  /// See early_end.hpp for which points are simulated in full.
  void evaluate_best(std::span<const double> xs, std::size_t best, std::span<double> objectives,
                     std::span<Status> statuses);
  Status linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                   std::span<double> jacobian);
  /// Constraint values and their Jacobian by the unit box; counted nowhere.
  Status constraints(std::span<const double> x, std::span<double> values, std::span<double> jacobian) const;
  [[nodiscard]] bool should_stop() const;

  [[nodiscard]] Status refusal() const;

  mutable Ledger ledger;  ///< mutable: looking at the clock may stop it
  Evaluations made;

 private:
  Status evaluate_at(std::span<const double> x, std::size_t slot, std::span<double> residuals,
                     std::span<double> jacobian, assembly::Workspace& workspace, bool bound_only = false);
  /// Evaluates the points in parallel. Returns how many of them, in order, are then known: all, unless is_over().
  std::size_t evaluate_slots(std::span<const double> xs, std::size_t first, std::span<const std::size_t> points,
                             bool bound_only);
  /// Simulates the points that early_ requests; the journal has the first `replayed` points of the batch.
  void simulate_early(std::span<const double> xs, const Evaluations::Call& call, std::size_t replayed);
  /// Evaluates the points of a batch after the first `replayed`, which the journal has. Returns how many points of the
  /// batch, in order, are then known. They are fewer than all if time was up or the user interrupted the work.
  std::size_t evaluate_lowest(std::span<const double> xs, std::size_t best, std::size_t replayed);
  /// Takes evaluation `slot` from the journal; false when it has none. Notes a contradiction.
  bool replay(std::span<const double> x, std::size_t slot);
  /// Whether a batch ends before its next evaluation.
  [[nodiscard]] bool is_over() const;
  /// The number of points, among the first `known` of the last call, before the first failure by an interruption. Later
  /// points are removed; resuming requests them again.
  std::size_t keep(std::size_t replayed, std::size_t known);
  void count(std::span<const double> xs, const Evaluations::Call& call);
  void contradict(std::size_t slot, std::string what);

  SharedState& shared_;
  std::optional<std::uint64_t> replay_from_;
  const std::atomic<bool>* needless_;
  GoodPoints good_;
  assembly::SecantMemory secant_;
  JournalEntry entry_;
  EarlyEnd early_;
  std::vector<std::size_t> points_;
};

}  // namespace tunica::search
