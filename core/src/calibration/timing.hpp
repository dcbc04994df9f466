// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace tunica::calibration {

/// Median time of a call, s: of as many as begin within a fifth of a second, and of 1001 at most. `now` is the clock,
/// in s.
double median_time(const std::function<void()>& call, const std::function<double()>& now);

}  // namespace tunica::calibration
