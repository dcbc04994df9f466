// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "assembly/noise.hpp"
#include "experiment/experiment.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::assembly {

/// The fitted rows of one channel as a block of the objective. With e = ŷ − y of row k,
///
///   r_k = own_k e_k − previous_k e_{k−1},
///
/// so that the objective is Σ_blocks weight · ρ(‖r‖²) as in tunica/optimizer.hpp.
struct ChannelObjective {
  std::size_t test = 0;
  ResidualBlock block;
  std::vector<std::size_t> rows;  ///< positions in the vector of all predictions
  std::vector<double> measured;
  std::vector<double> own, previous;  ///< previous is empty where neighbouring rows are uncorrelated
};

/// A prior of a free parameter as a residual (p − mean)/sd.
struct PriorRow {
  std::size_t index;
  double mean, sd;
};

/// The scaling of docs/theory.md, per channel with n fitted rows and weight w:
///
///   standardised_quadratic  J = w/n Σ (y − ŷ)² / |max y − min y|,  in base units    r = e/√(n·range)
///   least_squares           J = w Σ ((y − ŷ)/σ)², whitened by stated correlation    r = e/σ
///   sum_of_norms            J = w ‖y − ŷ‖                                           r = e, ρ = √
///
/// Fills own, previous, block.weight and block.loss. Throws InputError naming `where` when the range is zero,
/// or a measured value is too large for any unit.
void scale_residuals(ChannelObjective& fitted, experiment::ObjectiveType objective, double weight,
                     const NoiseModel* noise, const std::string& where);

/// weight · ρ(‖r‖²) of one channel against `measured`, one value a fitted row; `residuals` (all of the problem's) is
/// filled unless empty.
double channel_cost(const ChannelObjective& fitted, std::span<const double> measured,
                    std::span<const double> predictions, std::span<double> residuals);

}  // namespace tunica::assembly
