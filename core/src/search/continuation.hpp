// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "tunica/status.hpp"

namespace tunica::search {

/// The last successfully evaluated points of the unit box, for on_failure: retry.
class GoodPoints {
 public:
  static constexpr std::size_t remembered = 64;
  void add(std::span<const double> x);
  /// The point nearest to x, or empty.
  [[nodiscard]] std::span<const double> nearest(std::span<const double> x) const;

 private:
  std::vector<double> points_;
  std::size_t dimension_ = 0, next_ = 0;
};

/// on_failure: retry. It moves from a good point towards the failed one, and retries the failed point after each
/// successful step. A step covers half of the rest; after a failed step, the next one is half as long. There are at
/// most `continuation_steps` steps. A test's memory for warm starts carries over from step to step. Tests without such
/// memory, such as point tests, return the same result at the same point, and retrying them only costs time. Steps are
/// parts of one evaluation and are not counted. `evaluate` returns the status at a point; the result is the status of
/// the failed point itself.
constexpr int continuation_steps = 4;
Status continue_to(std::span<const double> good, std::span<const double> failed, const Status& failure,
                   const std::function<Status(std::span<const double>)>& evaluate);

}  // namespace tunica::search
