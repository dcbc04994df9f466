// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tunica::assembly {

/// `vector[position] = free[index]` before each evaluation.
struct Link {
  std::size_t position, index;
};

/// The parameter vector of one owner, a model or a test: the held values, and the positions of the free ones.
struct ParameterVector {
  std::vector<double> values;  ///< free ones at their initial value
  std::vector<Link> links;

  [[nodiscard]] std::vector<double> at(std::span<const double> free) const {
    std::vector<double> all = values;
    for (const Link& link : links) all[link.position] = free[link.index];
    return all;
  }
};

}  // namespace tunica::assembly
