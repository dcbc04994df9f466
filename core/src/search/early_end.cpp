// SPDX-License-Identifier: Apache-2.0
#include "search/early_end.hpp"

#include <algorithm>
#include <limits>

namespace tunica::search {

void EarlyEnd::clear() {
  order_.clear();
  objectives_.clear();
  taken_ = 0;
}

std::span<const std::size_t> EarlyEnd::next(std::size_t best) {
  if (taken_ == 0) std::sort(order_.begin(), order_.end());
  double threshold = std::numeric_limits<double>::infinity();
  if (best > 0 && objectives_.size() >= best) {
    const auto last = objectives_.begin() + static_cast<std::ptrdiff_t>(best) - 1;
    std::nth_element(objectives_.begin(), last, objectives_.end());
    threshold = *last;
  }
  const std::size_t most = taken_ == 0 ? std::max(best, std::size_t{1}) : std::max(least_chunk, best / 2);
  chunk_.clear();
  // Equal to the threshold is not above it: of equals the earlier point ranks first.
  while (taken_ < order_.size() && chunk_.size() < most && order_[taken_].first <= threshold)
    chunk_.push_back(order_[taken_++].second);
  return chunk_;
}

std::span<const std::size_t> EarlyEnd::left() {
  chunk_.clear();
  for (std::size_t k = taken_; k < order_.size(); ++k) chunk_.push_back(order_[k].second);
  return chunk_;
}

}  // namespace tunica::search
