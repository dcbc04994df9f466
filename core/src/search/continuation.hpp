// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "tunica/status.hpp"

namespace tunica::search {

/// The last points of the unit box that could be evaluated, for on_failure: retry.
class GoodPoints {
 public:
  static constexpr std::size_t remembered = 64;
  void add(std::span<const double> x);
  /// The nearest to x, or empty.
  [[nodiscard]] std::span<const double> nearest(std::span<const double> x) const;

 private:
  std::vector<double> points_;
  std::size_t dimension_ = 0, next_ = 0;
};

/// on_failure: retry. Walks from a good point towards the failed one: tries it again from ever nearer points,
/// half-way first, and half of the rest after each that succeeds; at most `continuation_steps` times. What a step
/// carries to the next is what a test keeps for warm starts. Tests without such memory, as the point tests are,
/// return the same at the same point, and retrying them only costs time. Steps are parts of one evaluation and not
/// counted. `evaluate` returns the status at a point; the result is that of the failed point itself.
constexpr int continuation_steps = 4;
Status continue_to(std::span<const double> good, std::span<const double> failed, const Status& failure,
                   const std::function<Status(std::span<const double>)>& evaluate);

}  // namespace tunica::search
