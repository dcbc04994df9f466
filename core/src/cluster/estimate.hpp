// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace tunica::cluster {

/// Time and memory of a few specimens, fitted here as in a shard.
struct Pilot {
  std::size_t specimens = 0;
  double mean_seconds = 0, longest_seconds = 0;  ///< of one specimen, on one of the threads
  double start_seconds = 0;                      ///< of the process, before the first fit
  std::size_t peak_bytes = 0;
};

/// The limits of a job in the queue.
struct Limits {
  std::size_t minutes = 0;
  std::size_t mebibytes = 0;
};

/// A shard takes about so long where nobody says how many there are: long against starting a job, short against what a
/// lost node costs.
constexpr double wanted_shard_seconds = 20 * 60;
/// Time limit = time_margin × (start + rounds × longest specimen) + spare_seconds: nodes may be slower than this
/// machine, and the pilot has seen a few specimens only. A shard that is cut off goes on from its records.
constexpr double time_margin = 2, spare_seconds = 120;
constexpr double memory_margin = 1.5;

/// As many shards as make each take wanted_shard_seconds; at least one specimen each, at most `largest_array`.
std::size_t shards_for(const Pilot& pilot, std::size_t specimens, unsigned threads, std::size_t largest_array);

/// What a shard of so many specimens takes by the pilot, in seconds: rounds of `threads` specimens side by side.
double shard_seconds(const Pilot& pilot, std::size_t specimens, unsigned threads);

Limits shard_limits(const Pilot& pilot, std::size_t specimens, unsigned threads);

/// The merge reads every specimen once more, as this process did in `scan_seconds` to see what is missing, and its
/// statistics evaluate each about as often as a fit of `mean_seconds`. Measured with two strips of 30 rows: once the
/// time of a fit, and 140 KiB a specimen. The limits are generous, for the merge runs once.
constexpr double merge_fits = 4, merge_bytes = 256 * 1024, merge_spare_bytes = 1 << 30;
Limits merge_limits(std::size_t specimens, double scan_seconds, double mean_seconds);

/// "1-3,7": members of a job array, of positions that rise.
class ArrayText {
 public:
  void add(std::size_t position);
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::size_t begin_ = 0, last_ = 0, kept_ = 0;
};

}  // namespace tunica::cluster
