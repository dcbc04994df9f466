// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <utility>

namespace tunica::comparison {

/// Of a sample, here over the realisations of a run: what a repetition with another seed would give.
struct SampleStatistics {
  std::size_t count = 0;
  double mean = 0;
  std::optional<double> sd;                       ///< s, with n − 1; none for one value
  std::optional<std::pair<double, double>> ci95;  ///< of the mean: mean ± t(0.975, n − 1) s/√n
};
SampleStatistics sample_statistics(std::span<const double> values);

/// An objective up to which a realisation counts as a success: the target where there is one, else within 0.1 % of
/// the best that any comparable realisation of this experiment found. The absolute 1e-12 lets perfect fits of
/// synthetic data count, whose objectives are rounding.
double success_threshold(std::optional<double> target, double best_known);

}  // namespace tunica::comparison
