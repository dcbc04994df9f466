// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "assembly/assembly.hpp"

namespace tunica::assembly {

/// The rows that say something about the parameters, with the noise they are taken to have: what intervals, profiles
/// and bootstrap share. Channels of weight 0 are left out; other weights do not enter, for they are no noise.
struct Whitening {
  struct Row {
    std::size_t prediction;  ///< position among all predictions
    double measured;
    double sd;         ///< σ: as stated, times `widening`; or else of the channel's residuals at the point
    double neighbour;  ///< stated correlation φ with the row before it in the channel; 0 in the first
  };
  struct Prior {
    std::size_t index;  ///< free parameter
    double mean, sd;
  };
  std::vector<Row> rows;           ///< channel after channel
  std::vector<std::size_t> first;  ///< where each channel begins, and the end: channels + 1 entries
  std::vector<Prior> priors;       ///< where the objective takes them into account
  bool stated = true;              ///< all noise is known
  double widening = 1;  ///< of stated σ: √(χ²/ν) where χ² contradicts the statement (misfit.hpp), else 1

  [[nodiscard]] std::size_t count() const { return rows.size() + priors.size(); }
  [[nodiscard]] std::size_t channels() const { return first.size() - 1; }
  /// 97.5 % point of standardised errors: of the normal distribution where all noise is stated and nothing
  /// contradicts it, else of Student's t with so many degrees of freedom as rows exceed `parameters`.
  [[nodiscard]] double quantile(std::size_t parameters) const;
};

/// `predictions` at the best point. A stated σ is believed unless χ² contradicts it. Of a channel without a statement
/// the σ that the fit weighs by is multiplied by √(χ²/ν) of the channel, of which it pays its share of the n
/// parameters, ν = count (1 − n/rows); a perfect fit is no licence for infinite weight, so that σ is at least 1e-9 of
/// the largest value. `believe`: a stated σ stays as it is, for points that
/// are no fits. To be made once, at the point that a run ended at: what follows (intervals, profiles, draws)
/// keeps it. No row where nothing is fitted. `measured` in the layout of the predictions stands in for the data unless
/// empty.
Whitening whitening(const Assembly& assembly, std::span<const double> predictions,
                    std::span<const double> measured = {}, bool believe = false);

/// Whitened residuals r = (e_k/σ_k − φ e_{k−1}/σ_{k−1})/√(1 − φ²), e = prediction − measured, then priors; and, unless
/// empty, their Jacobian by the free parameters, row-major, from that of all predictions.
void whitened_residuals(const Whitening& whitening, std::span<const double> free, std::span<const double> predictions,
                        std::span<const double> prediction_jacobian, std::span<double> residuals,
                        std::span<double> jacobian);

}  // namespace tunica::assembly
