// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <utility>

namespace tunica::comparison {

using Interval = std::pair<double, double>;

/// What a box plot draws. Quartiles by linear interpolation between order statistics (type 7 of Hyndman and Fan, The
/// American Statistician 50:361, 1996).
struct Box {
  double min = 0, lower = 0, median = 0, upper = 0, max = 0;
};

/// Of a sample, here over the realisations of a run: what a repetition with another seed would give.
struct SampleStatistics {
  std::size_t count = 0;
  double mean = 0;
  std::optional<double> sd;      ///< s, with n − 1; none for one value
  std::optional<Interval> ci95;  ///< of the mean: mean ± t(0.975, n − 1) s/√n
  std::optional<Box> box;        ///< none without values
};
SampleStatistics sample_statistics(std::span<const double> values);

/// 95 % interval of a probability from k successes in n trials (Wilson, J. Am. Stat. Assoc. 22:209, 1927): with
/// z = 1.96 and p = k/n,
///
///   (p + z²/2n ± z √(p(1 − p)/n + z²/4n²)) / (1 + z²/n).
///
/// Unlike the normal approximation it is right for 100 successes in 100. (0, 1) for no trials.
Interval wilson_interval(std::size_t successes, std::size_t trials);

/// An objective up to which a realisation counts as a success: the target where there is one, else within 0.1 % of
/// the best that any comparable realisation of this experiment found. The absolute 1e-12 lets perfect fits of
/// synthetic data count, whose objectives are rounding.
double success_threshold(std::optional<double> target, double best_known);

}  // namespace tunica::comparison
