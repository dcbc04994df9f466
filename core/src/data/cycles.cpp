// SPDX-License-Identifier: Apache-2.0
#include "data/cycles.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::data {
namespace {

constexpr double turned_by = 0.05;

/// Rows at which the path turns; a peak stands at its first row, a valley at its last.
std::vector<std::size_t> turns(std::span<const double> path, double outward) {
  const auto [low, high] = std::minmax_element(path.begin(), path.end());
  const double least = turned_by * (*high - *low);
  std::vector<std::size_t> found;
  std::size_t extreme = 0;
  int direction = 0;
  for (std::size_t row = 1; row < path.size(); ++row) {
    const double step = outward * (path[row] - path[extreme]);
    if (direction == 0) {
      if (std::abs(step) > least) direction = step > 0 ? 1 : -1;
      if (direction != 0) extreme = row;
    } else if (direction * step > 0 || (step == 0 && direction < 0)) {
      extreme = row;
    } else if (direction * step < -least) {
      found.push_back(extreme);
      extreme = row;
      direction = -direction;
    }
  }
  return found;
}

}  // namespace

std::vector<Branch> branches_of(std::span<const double> path, double rest) {
  if (path.empty()) return {};
  const auto [low, high] = std::minmax_element(path.begin(), path.end());
  const double outward = *high - rest >= rest - *low ? 1 : -1;
  const std::vector<std::size_t> turning = turns(path, outward);
  const std::size_t first_end = turning.empty() ? path.size() - 1 : turning.front();
  bool loading = outward * (path[first_end] - path.front()) >= 0;
  std::vector<Branch> branches;
  std::size_t begin = 0, cycle = 0;
  for (std::size_t k = 0; k <= turning.size(); ++k) {
    // The row of a peak belongs to the loading, that of a valley too.
    const std::size_t end = k == turning.size() ? path.size() : turning[k] + (loading ? 1 : 0);
    cycle += loading ? 1 : 0;
    if (end > begin) branches.push_back({begin, end, loading, cycle});
    begin = end;
    loading = !loading;
  }
  return branches;
}

std::size_t cycles_in(const std::vector<Branch>& branches) { return branches.empty() ? 0 : branches.back().cycle; }

std::size_t returns_in(std::span<const double> path, const std::vector<Branch>& branches) {
  if (path.empty()) return 0;
  const auto [low, high] = std::minmax_element(path.begin(), path.end());
  const double half = 0.5 * (*high - *low);
  return static_cast<std::size_t>(std::count_if(branches.begin(), branches.end(), [&](const Branch& branch) {
    return !branch.loading && branch.last > branch.first && branch.first > 0 &&
           std::abs(path[std::min(branch.last, path.size() - 1)] - path[branch.first - 1]) > half;
  }));
}

}  // namespace tunica::data
