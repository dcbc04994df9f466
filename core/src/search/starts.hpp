// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "search/oracle.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::search {

/// The problem of one of several independent searches. It keeps its evaluations until they are merged, and by its own
/// counts never stops before the merged search would. evaluations() and budget() count only its own evaluations, from
/// the budget at the beginning of its block of starts.
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
  /// Starts within a start run one after the other on this problem, each with its own seeds.
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

/// Runs starts in blocks of 8, 16, 32, then 64. The starts of a block run in parallel. Their evaluations are merged in
/// the order of the starts.
///
/// The outcome is that of sequential starts. A start may run beyond the point where the whole search stops; evaluations
/// beyond that point are discarded and not counted. Later starts of the block end at their next evaluation, and later
/// blocks do not run.
///
/// `merge` takes one start's evaluations; it is called in the order of the starts, never concurrently. `parent` is
/// what the search as a whole counts.
class Starts {
 public:
  Starts(SharedState& shared, Oracle& parent, std::function<void(const Evaluations&)> merge)
      : shared_(shared), parent_(parent), merge_(std::move(merge)) {}
  /// Returns how many starts would begin before the stop in a sequential run. With `paired`, all but the first begin at
  /// points derived from that number.
  std::size_t run(std::size_t count, std::uint64_t seed, std::optional<std::uint64_t> paired,
                  const std::function<void(std::size_t, Problem&)>& body);

 private:
  void run_block(std::size_t first, std::size_t size, std::uint64_t seed,
                 const std::function<void(std::size_t, Problem&)>& body);
  void take(StartProblem& start);
  [[nodiscard]] std::vector<double> start_of(std::size_t number) const;
  /// Notes where a start ended. Bounds that hold a search are reported, whichever start wins.
  void note_end(const Evaluations& made);

  SharedState& shared_;
  Oracle& parent_;
  std::function<void(const Evaluations&)> merge_;
  std::size_t begun_ = 0;
  std::optional<std::uint64_t> paired_;
};

}  // namespace tunica::search
