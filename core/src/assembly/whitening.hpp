// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "assembly/assembly.hpp"

namespace tunica::assembly {

/// The rows that inform the parameters, with their assumed noise. Intervals, profiles and bootstrap share them.
/// Channels of weight 0 are left out; other weights are ignored because they do not describe noise.
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
  /// The 97.5 % point of standardised errors. It is that of the normal distribution if all noise is stated and not
  /// contradicted. Otherwise it is that of Student's t, with rows minus `parameters` degrees of freedom.
  [[nodiscard]] double quantile(std::size_t parameters) const;
};

/// `predictions` are those at the best point. A stated σ holds unless χ² contradicts it. In a channel without stated
/// noise, the σ of the fit is multiplied by the channel's √(χ²/ν) with ν = count (1 − n/rows): each channel loses its
/// share of n degrees of freedom. σ is at least 1e-9 of the largest value, so that a perfect fit has no infinite
/// weight. `believe`: a stated σ never changes, for points that are not fits. Make it once, at the final point of a
/// run; intervals, profiles and draws then keep it. It has no row if nothing is fitted. `measured`, in the layout of
/// the predictions, replaces the data unless empty.
Whitening whitening(const Assembly& assembly, std::span<const double> predictions,
                    std::span<const double> measured = {}, bool believe = false);

/// Whitened residuals r = (e_k/σ_k − φ e_{k−1}/σ_{k−1})/√(1 − φ²), e = prediction − measured, then priors; and, unless
/// empty, their Jacobian by the free parameters, row-major, from that of all predictions.
void whitened_residuals(const Whitening& whitening, std::span<const double> free, std::span<const double> predictions,
                        std::span<const double> prediction_jacobian, std::span<double> residuals,
                        std::span<double> jacobian);

}  // namespace tunica::assembly
