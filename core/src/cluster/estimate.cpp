// SPDX-License-Identifier: Apache-2.0
#include "cluster/estimate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace tunica::cluster {

namespace {

constexpr double bytes_of_mebibyte = 1048576;

std::size_t rounds(std::size_t specimens, unsigned threads) { return (specimens + threads - 1) / threads; }

std::size_t minutes_of(double seconds) { return static_cast<std::size_t>(std::ceil(seconds / 60)); }

/// In steps of 64 MiB: two pilots then usually request the same.
std::size_t mebibytes_of(double bytes) {
  return static_cast<std::size_t>(std::ceil(bytes / bytes_of_mebibyte / 64)) * 64;
}

}  // namespace

std::size_t shards_for(const Pilot& pilot, std::size_t specimens, unsigned threads, std::size_t largest_array) {
  const double work = static_cast<double>(specimens) * pilot.mean_seconds / threads;
  const std::size_t most = std::max<std::size_t>(1, std::min(specimens, largest_array));
  return std::clamp(static_cast<std::size_t>(std::ceil(work / wanted_shard_seconds)), std::size_t{1}, most);
}

double shard_seconds(const Pilot& pilot, std::size_t specimens, unsigned threads) {
  return pilot.start_seconds + static_cast<double>(rounds(specimens, threads)) * pilot.mean_seconds;
}

Limits shard_limits(const Pilot& pilot, std::size_t specimens, unsigned threads) {
  const double longest = pilot.start_seconds + static_cast<double>(rounds(specimens, threads)) * pilot.longest_seconds;
  return {minutes_of(time_margin * longest + spare_seconds),
          mebibytes_of(memory_margin * static_cast<double>(pilot.peak_bytes))};
}

Limits merge_limits(std::size_t specimens, double scan_seconds, double mean_seconds) {
  constexpr double least_seconds = 30 * 60, scans = 20;
  const auto number = static_cast<double>(specimens);
  return {minutes_of(least_seconds + scans * scan_seconds + merge_fits * number * mean_seconds),
          mebibytes_of(merge_spare_bytes + merge_bytes * number)};
}

void ArrayText::add(std::size_t position) {
  if (last_ != 0 && position == last_ + 1) {
    text_ = fmt::format("{}{}-{}", text_.substr(0, kept_), begin_, position);
  } else {
    if (!text_.empty()) text_ += ',';
    kept_ = text_.size();
    begin_ = position;
    text_ += fmt::format("{}", position);
  }
  last_ = position;
}

}  // namespace tunica::cluster
