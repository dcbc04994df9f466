// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "data/dataset.hpp"

namespace tunica::assembly {

/// Noise of the fitted rows of one channel, for least squares.
struct NoiseModel {
  std::vector<double> sd;         ///< one per fitted row
  std::vector<double> neighbour;  ///< correlation with the fitted row before it; empty = uncorrelated
  bool estimated = false;
  std::size_t terms = 0;  ///< rows, or differences of neighbours, that an estimate is the mean of
};

/// The standard deviation σ of each fitted row. Stated: σ² = absolute² + (relative·y)², and a mean over m replicates
/// has σ/√m; a row to which the statement gives σ = 0 (y = 0 under relative noise) takes the smallest σ of the others,
/// with a warning. Stated correlation c of neighbouring rows becomes c^g across g − 1 rows that are held out.
///
/// Without a statement, the channel has one σ, and always a warning. With replicates, it is the pooled deviation about
/// the row means. Without replicates, it is the deviation of each measured value from the line through its two
/// neighbours in loading order (Gasser, Sroka, Jennen-Steinmetz, Biometrika 73:625, 1986), without turning points,
///
///   σ² = mean of (a y₋ + b y₊ − y)² / (a² + b² + 1),   a = (x₊ − x)/(x₊ − x₋),  b = 1 − a,
///
/// It never uses residuals of a fit, because the misfit of a wrong model would pass for noise. Smooth curvature makes σ
/// slightly too large; correlation between neighbours makes it too small. Throws InputError when nothing can be
/// estimated; `where` names test and channel.
NoiseModel noise_model(const data::Channel& channel, std::span<const double> abscissa, const std::vector<bool>& fitted,
                       const std::string& where, std::vector<std::string>& warnings);

}  // namespace tunica::assembly
