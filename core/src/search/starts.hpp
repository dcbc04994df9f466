// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "search/oracle.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::search {

/// The problem one of several independent searches sees. It keeps what it evaluated until somebody merges it, and
/// stops at the latest where the merged search has: evaluations() and budget() count its own, from the budget there
/// was when its block of starts began.
class StartProblem : public Problem {
 public:
  StartProblem(SharedState& shared, Ledger ledger, std::uint64_t seed, std::vector<double> start,
               std::optional<std::uint64_t> replay_from, const std::atomic<bool>* needless = nullptr);

  [[nodiscard]] std::size_t dimension() const override { return shared_.parameters; }
  [[nodiscard]] std::span<const double> start() const override { return start_; }
  [[nodiscard]] std::span<const ResidualBlock> blocks() const override { return shared_.assembly.layout().blocks; }
  [[nodiscard]] std::size_t residual_count() const override { return shared_.assembly.layout().residual_count; }
  [[nodiscard]] std::size_t constraint_count() const override { return shared_.assembly.constraints().count(); }
  Status evaluate(std::span<const double> x, double& objective) override;
  void evaluate_batch(std::span<const double> xs, std::span<double> objectives, std::span<Status> statuses) override;
  void evaluate_best(std::span<const double> xs, std::size_t best, std::span<double> objectives,
                     std::span<Status> statuses) override {
    oracle.evaluate_best(xs, best, objectives, statuses);
  }
  Status linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                   std::span<double> jacobian) override;
  Status constraints(std::span<const double> x, std::span<double> values, std::span<double> jacobian) override {
    return oracle.constraints(x, values, jacobian);
  }
  /// Starts within a start run one after the other on this problem, each with seeds of its own.
  std::size_t for_each_start(std::size_t count, const std::function<void(std::size_t, Problem&)>& body) override;
  [[nodiscard]] bool should_stop() const override { return oracle.should_stop(); }
  [[nodiscard]] std::uint64_t evaluations() const override { return oracle.ledger.tally().evaluations; }
  [[nodiscard]] std::uint64_t budget() const override { return oracle.ledger.budget(); }
  [[nodiscard]] std::uint64_t seed(std::string_view purpose) const override;

  Oracle oracle;

 private:
  SharedState& shared_;
  std::uint64_t seed_;
  std::vector<double> start_;  ///< unit box
};

/// Runs starts block by block, of 8, 16, 32, then 64, each block side by side, and merges what they evaluated in the
/// order of the starts.
///
/// The outcome is that of one start after the other: a start may have gone on beyond the point where the search as a
/// whole stops; what lies beyond is discarded and not counted, later starts under way end at their next evaluation, and
/// later blocks do not run.
///
/// `merge` takes one start's evaluations; it is called in the order of the starts, never concurrently. `parent` is
/// what the search as a whole counts.
class Starts {
 public:
  Starts(SharedState& shared, Oracle& parent, std::function<void(const Evaluations&)> merge)
      : shared_(shared), parent_(parent), merge_(std::move(merge)) {}
  /// Returns how many begin before the stop when they run one after the other. With `paired` all but the first begin at
  /// points that follow from that number.
  std::size_t run(std::size_t count, std::uint64_t seed, std::optional<std::uint64_t> paired,
                  const std::function<void(std::size_t, Problem&)>& body);

 private:
  void run_block(std::size_t first, std::size_t size, std::uint64_t seed,
                 const std::function<void(std::size_t, Problem&)>& body);
  void take(StartProblem& start);
  [[nodiscard]] std::vector<double> start_of(std::size_t number) const;
  /// Where a start ended: bounds that hold a search are to be told, whichever start wins.
  void note_end(const Evaluations& made);

  SharedState& shared_;
  Oracle& parent_;
  std::function<void(const Evaluations&)> merge_;
  std::size_t begun_ = 0;
  std::optional<std::uint64_t> paired_;
};

}  // namespace tunica::search
