// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "uncertainty/refit.hpp"

namespace tunica::uncertainty {

/// A residual bootstrap: data sets that might have been measured, made from the best fit and its own residuals, each
/// fitted again from the best point with the run's own objective.
struct Bootstrap {
  struct Draw {
    Status status;
    std::vector<double> free;  ///< empty when failed
    double objective = 0;
    bool converged = false;
  };
  std::vector<Draw> draws;
  std::vector<std::size_t> blocks;  ///< length of the resampled blocks, by channel of the whitening; 1 = single rows
  std::vector<double> correlation;  ///< of neighbouring residuals, estimated, by channel
  std::size_t failures = 0;
  /// Percentile intervals of the free parameters, from the draws that did not fail; none with fewer than 40 of them.
  std::vector<std::optional<std::pair<double, double>>> ci95;
};

/// With e = y − ŷ at the best point and h the leverages (the diagonal of the hat matrix of the whitened problem),
///
///   z_i = e_i/(σ_i √(1 − h_i)) minus the mean of its channel,   y*_i = ŷ_i + σ_i z_{I(i)}
///
/// for indices I drawn with replacement within a channel. Where the lag-1 correlation φ of z exceeds 2/√n, blocks of
/// neighbours are drawn instead, of length (√6 |φ|/(1 − φ²))^{2/3} n^{1/3} (E. Carlstein, Ann. Stat. 14:1171, 1986), at
/// most n/3, around the ends: smooth misfit then counts as what it is, few independent numbers. Leverages and blocks:
/// A. C. Davison, D. V. Hinkley, Bootstrap Methods and their Application (1997), sections 6.2 and 8.2.
///
/// Draw k depends on seed and k alone, so that the outcome is the same for any number of threads. Priors are not
/// resampled. Once `interrupted` returns true what is missing counts as failed. Throws nothing; fails as a whole (no
/// draws) where the best point cannot be linearised.
Bootstrap bootstrap(const assembly::Assembly& assembly, std::span<const double> best, const LocalOptimizer& optimizer,
                    std::size_t draws, std::uint64_t seed, const std::function<bool()>& interrupted = {});

}  // namespace tunica::uncertainty
