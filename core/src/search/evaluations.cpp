// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "search/oracle.hpp"

namespace tunica::search {

void Evaluations::grow(std::size_t count, bool jacobian, std::size_t parameter_count, std::size_t test_count) {
  calls.push_back({size(), count, jacobian});
  const std::size_t total = size() + count;
  parameters.resize(total * parameter_count);
  per_test.resize(total * test_count);
  objectives.resize(total);
  seconds.resize(total);
  statuses.resize(total);
  ended_early.resize(total);
}

void Evaluations::drop_call(std::size_t parameter_count, std::size_t test_count) {
  const std::size_t left = calls.back().first;
  calls.pop_back();
  parameters.resize(left * parameter_count);
  per_test.resize(left * test_count);
  objectives.resize(left);
  seconds.resize(left);
  statuses.resize(left);
  ended_early.resize(left);
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
  parameters.clear();
  per_test.clear();
  objectives.clear();
  seconds.clear();
  statuses.clear();
  ended_early.clear();
}

}  // namespace tunica::search
