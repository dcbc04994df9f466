// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "tunica/status.hpp"

namespace tunica::python {

/// The step that balances truncation h²f‴ against rounding εf/h, on this scale.
inline double step_on(double scale) { return std::cbrt(std::numeric_limits<double>::epsilon()) * scale; }

/// The function to difference: writes f(x₀ + offset).
using Moved = std::function<Status(double offset, std::span<double> into)>;

/// (f(h) − f(−h))/2h into `column` or, where one side is not there, (4f(±h) − 3f(0) − f(±2h))/(±2h).
inline Status difference(const Moved& f, double h, bool above, bool below, std::span<const double> here,
                         std::span<double> column) {
  std::vector<double> near(column.size()), far(column.size());
  const double first = above ? h : -h, second = above && below ? -h : 2 * first;
  if (Status status = f(first, near); !status.ok()) return status;
  if (Status status = f(second, far); !status.ok()) return status;
  for (std::size_t i = 0; i < column.size(); ++i)
    column[i] = above && below ? (near[i] - far[i]) / (2 * h) : (4 * near[i] - 3 * here[i] - far[i]) / (2 * first);
  return {};
}

}  // namespace tunica::python
