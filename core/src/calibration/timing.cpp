// SPDX-License-Identifier: Apache-2.0
#include "calibration/timing.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tunica::calibration {

double median_time(const std::function<void()>& call, const std::function<double()>& now) {
  constexpr double longest = 0.2;  // s
  constexpr std::size_t most = 1001;
  std::vector<double> times;
  double begun = now();
  const double end = begun + longest;
  do {
    call();
    const double after = now();
    times.push_back(after - begun);
    begun = after;
  } while (begun < end && times.size() < most);
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

}  // namespace tunica::calibration
