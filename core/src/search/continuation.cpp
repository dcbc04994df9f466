// SPDX-License-Identifier: Apache-2.0
#include "search/continuation.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace tunica::search {

void GoodPoints::add(std::span<const double> x) {
  dimension_ = x.size();
  if (points_.size() < remembered * dimension_) {
    points_.insert(points_.end(), x.begin(), x.end());
    return;
  }
  std::copy(x.begin(), x.end(), points_.begin() + static_cast<std::ptrdiff_t>(next_ * dimension_));
  next_ = (next_ + 1) % remembered;
}

std::span<const double> GoodPoints::nearest(std::span<const double> x) const {
  std::span<const double> found;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t at = 0; at < points_.size(); at += dimension_) {
    const std::span<const double> point = std::span(points_).subspan(at, dimension_);
    double distance = 0;
    for (std::size_t j = 0; j < dimension_; ++j) distance += (point[j] - x[j]) * (point[j] - x[j]);
    if (distance < shortest) {
      shortest = distance;
      found = point;
    }
  }
  return found;
}

Status continue_to(std::span<const double> good, std::span<const double> failed, const Status& failure,
                   const std::function<Status(std::span<const double>)>& evaluate) {
  std::vector<double> from(good.begin(), good.end()), between(failed.size());
  double step = 0.5;
  for (int tries = 0; tries < continuation_steps; ++tries) {
    for (std::size_t j = 0; j < failed.size(); ++j) between[j] = from[j] + step * (failed[j] - from[j]);
    if (!evaluate(between).ok()) {
      step /= 2;
      continue;
    }
    from = between;
    step = 0.5;
    Status status = evaluate(failed);
    if (status.kind() != Status::Kind::failed) return status;
  }
  return Status::failed(fmt::format("{} (it failed again in {} steps from the nearest good point)", failure.reason(),
                                    continuation_steps));
}

}  // namespace tunica::search
