// SPDX-License-Identifier: Apache-2.0
#include "population/multiplicity.hpp"

#include <algorithm>
#include <numeric>

namespace tunica::population {

std::vector<double> holm(const std::vector<double>& p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> result(p_values.size());
  double highest = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    highest = std::max(highest, std::min(1.0, p_values[order[k]] * static_cast<double>(order.size() - k)));
    result[order[k]] = highest;
  }
  return result;
}

}  // namespace tunica::population
