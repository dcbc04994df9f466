// SPDX-License-Identifier: Apache-2.0
#include "search/starts.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>

#include "search/random_point.hpp"
#include "tunica/random.hpp"

namespace tunica::search {
namespace {

constexpr std::size_t first_block = 8, largest_block = 64;

std::uint64_t seed_of_start(std::uint64_t seed, std::size_t number) {
  return derive_seed(seed, fmt::format("start {}", number));
}

}  // namespace

StartProblem::StartProblem(SharedState& shared, Ledger ledger, std::uint64_t seed, std::vector<double> start,
                           std::optional<std::uint64_t> replay_from, const std::atomic<bool>* needless)
    : oracle(shared, std::move(ledger), replay_from, needless),
      shared_(shared),
      seed_(seed),
      start_(std::move(start)) {}

Status StartProblem::evaluate(std::span<const double> x, double& objective) { return oracle.evaluate(x, objective); }

void StartProblem::evaluate_batch(std::span<const double> xs, std::span<double> objectives,
                                  std::span<Status> statuses) {
  oracle.evaluate_batch(xs, objectives, statuses);
}

Status StartProblem::linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                               std::span<double> jacobian) {
  return oracle.linearise(x, objective, residuals, jacobian);
}

std::size_t StartProblem::for_each_start(std::size_t count, const std::function<void(std::size_t, Problem&)>& body) {
  const std::uint64_t own = seed_;
  std::size_t k = 0;
  for (; k < count && !should_stop(); ++k) {
    seed_ = seed_of_start(own, k);
    body(k, *this);
  }
  seed_ = own;
  return k;
}

std::uint64_t StartProblem::seed(std::string_view purpose) const { return derive_seed(seed_, purpose); }

std::vector<double> Starts::start_of(std::size_t number) const {
  if (!paired_ || number == 0) return shared_.start;
  return random_point(seed_of_start(*paired_, number), shared_.parameters);
}

void Starts::take(StartProblem& start) {
  begun_ += parent_.ledger.stopped() ? 0 : 1;
  note_end(start.oracle.made);
  merge_(start.oracle.made);
  // A start that the clock or the user ended is incomplete, so later starts must not be counted.
  const StopReason reason = start.oracle.ledger.stop_reason();
  if (reason == StopReason::interrupted || reason == StopReason::max_time) parent_.ledger.stop(reason);
  start.oracle.made = {};
}

void Starts::note_end(const Evaluations& made) {
  if (parent_.ledger.stopped()) return;  // it belongs to no search
  std::size_t best = made.size();
  for (std::size_t k = 0; k < made.size(); ++k)
    if (made.statuses[k].ok() && made.ended_early[k] == 0 &&
        (best == made.size() || made.objectives[k] < made.objectives[best]))
      best = k;
  if (best == made.size()) return;
  const std::size_t n = shared_.parameters;
  std::vector<double> x(n);
  shared_.box.to_unit(std::span(made.parameters).subspan(best * n, n), x);
  parent_.ledger.add_start(x, made.objectives[best]);
}

void Starts::run_block(std::size_t first, std::size_t size, std::uint64_t seed,
                       const std::function<void(std::size_t, Problem&)>& body) {
  const Ledger at_begin = parent_.ledger.for_one_start();
  std::size_t k = 0;
  // A journal numbers evaluations in the merged order, so starts that it covers run one after the other.
  for (; k < size && shared_.replaying && !parent_.ledger.stopped(); ++k) {
    StartProblem start(shared_, at_begin, seed_of_start(seed, first + k), start_of(first + k),
                       parent_.ledger.next_index());
    body(first + k, start);
    take(start);
  }
  std::vector<std::unique_ptr<StartProblem>> starts(size);
  std::vector<char> finished(size, 0);
  std::atomic<bool> needless = parent_.ledger.stopped();
  std::size_t next = k;
  std::mutex mutex;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(k, size, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t at = range.begin(); at < range.end(); ++at) {
          starts[at] = std::make_unique<StartProblem>(shared_, at_begin, seed_of_start(seed, first + at),
                                                      start_of(first + at), std::nullopt, &needless);
          body(first + at, *starts[at]);
          const std::lock_guard lock(mutex);
          finished[at] = 1;
          for (; next < size && finished[next]; ++next) {
            take(*starts[next]);
            starts[next].reset();
          }
          needless = parent_.ledger.stopped();
        }
      },
      tbb::simple_partitioner());
}

std::size_t Starts::run(std::size_t count, std::uint64_t seed, std::optional<std::uint64_t> paired,
                        const std::function<void(std::size_t, Problem&)>& body) {
  paired_ = paired;
  for (std::size_t done = 0, block = first_block; done < count && !parent_.should_stop();
       block = std::min(2 * block, largest_block)) {
    const std::size_t size = std::min(block, count - done);
    run_block(done, size, seed, body);
    done += size;
  }
  return begun_;
}

}  // namespace tunica::search
