// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "tunica/optimizer.hpp"

namespace tunica {

/// Where one of the searches of Problem::for_each_start() begins: at `own`, the point that the optimizer has chosen,
/// unless the host gives the child a start() that differs from that of its parent. It does where an experiment asks for
/// "paired_starts", so that other optimizers begin at the same point.
inline std::vector<double> start_of_search(const Problem& parent, const Problem& child, std::vector<double> own) {
  const auto given = child.start();
  return std::ranges::equal(given, parent.start()) ? std::move(own) : std::vector<double>(given.begin(), given.end());
}

}  // namespace tunica
