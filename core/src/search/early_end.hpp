// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace tunica::search {

/// Which points of a batch are simulated in full where only the `best` lowest objectives are wanted, and a lower bound
/// of each is known from its cheap tests.
///
/// Points are taken in the order of their bounds. The rule ends where the next bound exceeds the best-th lowest
/// objective of the points before it: no other point can be among the lowest. A thread does not wait for what others
/// still simulate, so it may take points too many. left() names them too, and what they gave is to be forgotten. So
/// what counts depends on the numbers alone, and is the same for any number of threads.
///
/// take() and found() may be called from any thread, the others from one.
class EarlyEnd {
 public:
  /// Forgets the last batch.
  void clear();
  /// A point that can be evaluated and is feasible, with its lower bound.
  void add(std::size_t point, double bound) { order_.emplace_back(bound, point); }
  /// All points are there, and the `best` lowest of them are wanted.
  void begin(std::size_t best);
  [[nodiscard]] std::size_t size() const { return order_.size(); }

  struct Taken {
    std::size_t point, place;  ///< its place in the order of the bounds
  };
  /// What to simulate next; nothing when the rest cannot be among the lowest.
  std::optional<Taken> take();
  /// What the simulation gave; nothing where it failed or the point is infeasible.
  void found(Taken taken, std::optional<double> objective);

  /// Once no thread simulates: whether the rest cannot be among the lowest. Else the work was ended before.
  [[nodiscard]] bool is_complete() const;
  /// Once no thread simulates: the points that cannot be among the lowest; the first `needless` of them were taken.
  std::span<const std::size_t> left();
  [[nodiscard]] std::size_t needless() const { return needless_; }

 private:
  /// The best-th lowest objectives of what was added, the largest first; a heap.
  class Lowest {
   public:
    explicit Lowest(std::size_t best) : best_(best) {}
    void add(double objective);
    /// Whether a point of this bound may belong to them. Equal to the last is not above it: of equals the earlier point
    /// ranks first.
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
