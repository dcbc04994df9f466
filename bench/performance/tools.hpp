// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "plugins.hpp"
#include "tunica/status.hpp"

namespace tunica::bench {

inline void check(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.reason());
}

/// The largest difference over the largest value.
inline double difference(std::span<const double> a, std::span<const double> b) {
  double off = 0, largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    off = std::max(off, std::abs(a[i] - b[i]));
    largest = std::max(largest, std::abs(a[i]));
  }
  return off / largest;
}

}  // namespace tunica::bench
