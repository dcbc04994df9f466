// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace tunica::search {

/// Which points of a batch are simulated in full where only the `best` lowest objectives are wanted, and a lower bound
/// of each is known from its cheap tests.
///
/// The lower bounds decide the order. The first `best` points are simulated, then chunks of the others, until the next
/// bound exceeds the best-th lowest objective found so far: no other point can be among the lowest. The choice depends
/// on the numbers alone, so that it is the same for any number of threads.
class EarlyEnd {
 public:
  static constexpr std::size_t least_chunk = 4;  ///< points at a time, so that threads have something to share

  /// Forgets the last batch.
  void clear();
  /// A point that can be evaluated and is feasible, with its lower bound.
  void add(std::size_t point, double bound) { order_.emplace_back(bound, point); }
  /// What to simulate next; empty when the rest cannot be among the `best` lowest.
  std::span<const std::size_t> next(std::size_t best);
  /// An objective that was simulated.
  void found(double objective) { objectives_.push_back(objective); }
  /// The points that were not simulated, once next() has returned none.
  std::span<const std::size_t> left();

 private:
  std::vector<std::pair<double, std::size_t>> order_;  ///< bound, point; sorted once next() was called
  std::size_t taken_ = 0;
  std::vector<double> objectives_;
  std::vector<std::size_t> chunk_;
};

}  // namespace tunica::search
