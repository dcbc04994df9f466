// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "tunica/error.hpp"

namespace tunica {

/// Rows of a test with memory are a path. Throws InputError where a row is earlier than the one before it.
inline void check_loading_order(const std::string& test, std::span<const double> time) {
  for (std::size_t i = 1; i < time.size(); ++i)
    if (!(time[i] >= time[i - 1]))
      throw InputError(test + ": time runs backwards at row " + std::to_string(i + 1) +
                       "; give the rows in the order in which they were measured");
}

}  // namespace tunica
