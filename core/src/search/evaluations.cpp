// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "search/oracle.hpp"

namespace tunica::search {

void Evaluations::resize(std::size_t slots, std::size_t parameter_count, std::size_t test_count) {
  parameters.resize(slots * parameter_count);
  per_test.resize(slots * test_count);
  objectives.resize(slots);
  seconds.resize(slots);
  statuses.resize(slots);
  ended_early.resize(slots);
}

void Evaluations::grow(std::size_t count, bool jacobian, std::size_t parameter_count, std::size_t test_count) {
  calls.push_back({size(), count, jacobian});
  resize(size() + count, parameter_count, test_count);
}

void Evaluations::cut_call(std::size_t size, std::size_t parameter_count, std::size_t test_count) {
  calls.back().size = size;
  resize(calls.back().first + size, parameter_count, test_count);
  if (size == 0) calls.pop_back();
}

Extent Evaluations::extent(std::size_t slot, std::size_t test_count) const {
  if (ended_early[slot] != 0) return Extent::ended_early;
  if (statuses[slot].kind() != Status::Kind::infeasible) return Extent::whole;
  const auto cost = per_test.begin() + static_cast<std::ptrdiff_t>(slot * test_count);
  const bool left_out =
      std::any_of(cost, cost + static_cast<std::ptrdiff_t>(test_count), [](double value) { return std::isnan(value); });
  return left_out ? Extent::without_costly_tests : Extent::whole;
}

void Evaluations::clear() {
  calls.clear();
  resize(0, 0, 0);
}

}  // namespace tunica::search
