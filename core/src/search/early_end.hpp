// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace tunica::search {

/// Decides which points of a batch are simulated in full, if only the `best` lowest objectives are wanted. The cheap
/// tests of each point give a lower bound of its objective.
///
/// Points are taken in the order of their bounds. The rule stops when the next bound exceeds the best-th lowest
/// objective of the points before it: no other point can then be among the lowest. A thread does not wait for
/// simulations of other threads, so it may take too many points. left() also names these, and their results must be
/// discarded. The counted points therefore depend only on the numbers, and are the same for any number of threads.
///
/// take() and found() may be called from any thread, the others from one.
class EarlyEnd {
 public:
  /// Forgets the last batch.
  void clear();
  /// Adds a feasible point without failure, with its lower bound.
  void add(std::size_t point, double bound) { order_.emplace_back(bound, point); }
  /// All points are added; the `best` lowest of them are wanted.
  void begin(std::size_t best);
  [[nodiscard]] std::size_t size() const { return order_.size(); }

  struct Taken {
    std::size_t point, place;  ///< its place in the order of the bounds
  };
  /// The next point to simulate; none if no remaining point can be among the lowest.
  std::optional<Taken> take();
  /// The objective from the simulation; none if it failed or the point is infeasible.
  void found(Taken taken, std::optional<double> objective);

  /// Call it when no thread simulates any more. Whether no remaining point can be among the lowest; otherwise the work
  /// ended early.
  [[nodiscard]] bool is_complete() const;
  /// Call it when no thread simulates any more. The points that cannot be among the lowest; the first `needless` of
  /// them were simulated.
  std::span<const std::size_t> left();
  [[nodiscard]] std::size_t needless() const { return needless_; }

 private:
  /// The best-th lowest objectives of what was added, the largest first; a heap.
  class Lowest {
   public:
    explicit Lowest(std::size_t best) : best_(best) {}
    void add(double objective);
    /// Whether a point with this bound may belong to them. A bound equal to the last one may: among equals the earlier
    /// point ranks first.
    [[nodiscard]] bool admits(double bound) const { return values_.size() < best_ || bound <= values_.front(); }

   private:
    std::size_t best_;
    std::vector<double> values_;
  };

  std::mutex mutex_;
  std::vector<std::pair<double, std::size_t>> order_;  ///< bound, point; sorted by begin()
  std::vector<std::optional<double>> objectives_;      ///< by place
  std::size_t best_ = 0, taken_ = 0, needless_ = 0;
  Lowest lowest_{0};  ///< of what was found so far
  std::vector<std::size_t> left_;
};

}  // namespace tunica::search
