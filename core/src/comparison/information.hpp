// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "assembly/assembly.hpp"
#include "experiment/experiment.hpp"

namespace tunica::comparison {

/// The cost of a model in parameters against its gain in fit.
struct Information {
  enum class Noise { stated, estimated, mixed };
  std::optional<double> aicc;  ///< none when there are too few rows for the correction
  double bic = 0;
  Noise noise = Noise::stated;
};

/// Akaike's criterion with the correction for small samples (Hurvich and Tsai, Biometrika 76:297, 1989) and the
/// Bayesian one (Schwarz, Ann. Stat. 6:461, 1978), up to a constant that only depends on the data:
///
///   AICc = D + 2k + 2k(k + 1)/(N − k − 1),   BIC = D + k ln N,
///   D = Σ_stated r²  +  n ln(Σ_unstated r²/n)
///
/// over the N fitted rows of all channels; r are the whitened residuals of the fit, n the rows of channels whose noise
/// is not stated. Of those σ is known up to one factor (channel_noise.hpp), which is one more parameter, so that the
/// best point of the run is the most likely one. k counts the free parameters and that factor. Differences between
/// models on the same tests mean something, the values do not.
///
/// None but for `least_squares`, without priors, all weights 1 (or 0): elsewhere the best point does not have the
/// greatest likelihood. None for a perfect fit.
std::optional<Information> information(const assembly::Assembly& assembly, experiment::ObjectiveType objective,
                                       std::span<const double> free);

}  // namespace tunica::comparison
