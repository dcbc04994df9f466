// SPDX-License-Identifier: Apache-2.0
#include "search/early_end.hpp"

#include <algorithm>

namespace tunica::search {

void EarlyEnd::Lowest::add(double objective) {
  if (values_.size() == best_) {
    if (best_ == 0 || objective >= values_.front()) return;
    std::pop_heap(values_.begin(), values_.end());
    values_.pop_back();
  }
  values_.push_back(objective);
  std::push_heap(values_.begin(), values_.end());
}

void EarlyEnd::clear() {
  order_.clear();
  taken_ = needless_ = 0;
}

void EarlyEnd::begin(std::size_t best) {
  std::sort(order_.begin(), order_.end());
  objectives_.assign(order_.size(), std::nullopt);
  best_ = std::max<std::size_t>(best, 1);
  lowest_ = Lowest(best_);
}

bool EarlyEnd::is_complete() const {
  // Among fewer points the best-th lowest objective is higher, so no point is left out too early.
  return taken_ == order_.size() || !lowest_.admits(order_[taken_].first);
}

std::optional<EarlyEnd::Taken> EarlyEnd::take() {
  const std::lock_guard lock(mutex_);
  if (is_complete()) return std::nullopt;
  const std::size_t place = taken_++;
  return Taken{order_[place].second, place};
}

void EarlyEnd::found(Taken taken, std::optional<double> objective) {
  const std::lock_guard lock(mutex_);
  objectives_[taken.place] = objective;
  if (objective) lowest_.add(*objective);
}

std::span<const std::size_t> EarlyEnd::left() {
  Lowest before(best_);
  std::size_t place = 0;
  for (; place < taken_ && before.admits(order_[place].first); ++place)
    if (objectives_[place]) before.add(*objectives_[place]);
  needless_ = taken_ - place;
  left_.clear();
  for (; place < order_.size(); ++place) left_.push_back(order_[place].second);
  return left_;
}

}  // namespace tunica::search
