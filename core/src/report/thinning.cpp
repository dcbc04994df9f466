// SPDX-License-Identifier: Apache-2.0
#include "report/thinning.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::report {

std::vector<std::size_t> evenly(std::size_t count, std::size_t most) {
  std::vector<std::size_t> places;
  if (count == 0 || most == 0) return places;
  const std::size_t taken = std::min(count, most);
  for (std::size_t k = 0; k < taken; ++k)
    places.push_back(taken == 1 ? 0 : (k * (count - 1) + (taken - 1) / 2) / (taken - 1));
  return places;
}

std::vector<std::size_t> shape_keeping(std::span<const double> y, std::size_t most) {
  std::vector<std::size_t> finite;
  for (std::size_t i = 0; i < y.size(); ++i)
    if (std::isfinite(y[i])) finite.push_back(i);
  if (finite.size() <= most) return finite;
  std::vector<std::size_t> kept{finite.front()};
  const std::size_t inner = finite.size() - 2, parts = (most - 2) / 2;
  for (std::size_t part = 0; part < parts; ++part) {
    const auto begin = finite.begin() + 1 + static_cast<std::ptrdiff_t>(part * inner / parts);
    const auto end = finite.begin() + 1 + static_cast<std::ptrdiff_t>((part + 1) * inner / parts);
    if (begin == end) continue;
    const auto lower = [&](std::size_t a, std::size_t b) { return y[a] < y[b]; };
    const auto [low, high] = std::minmax_element(begin, end, lower);
    kept.push_back(std::min(*low, *high));
    if (*low != *high) kept.push_back(std::max(*low, *high));
  }
  kept.push_back(finite.back());
  return kept;
}

}  // namespace tunica::report
