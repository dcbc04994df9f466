// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "diagnosis/result.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::diagnosis {

/// The source of a channel's noise, and its accuracy.
struct NoiseSource {
  enum class Kind { stated, replicates, encompassing, differences };
  std::string test, channel, unit;
  Kind kind = Kind::stated;
  data::Noise noise;          ///< of one measured value
  double freedom = 0;         ///< degrees of freedom of σ²; 0 = known
  double correlation_sd = 0;  ///< standard deviation of the estimated correlation

  /// Neither stated nor from replicates: estimated from residuals (encompassing_noise.hpp).
  [[nodiscard]] bool open() const { return kind == Kind::encompassing || kind == Kind::differences; }
  double neighbours = 0;          ///< open: σ from differences of neighbouring rows; 0 where there are none
  double neighbours_freedom = 0;  ///< degrees of freedom of that
  double resolution = 0;          ///< open: lower bound of σ, from the step of the values or their digits
};

/// The noise of every channel of the tests, so that every model is judged by the same noise. Stated noise stays as it
/// is. Otherwise
///
///   replicates: σ² = a² + (b y)² fitted to the squared deviations from the row means (b only where it raises the
///               likelihood by more than 4), and the correlation of neighbouring deviations, pooled over channels and
///               over the tests that agree on it, where it exceeds twice its standard deviation;
///   else:       deviations from the line through neighbouring rows (assembly/noise.hpp), uncorrelated, until the
///               residuals can be asked (encompassing_noise.hpp); where there are no neighbours, the resolution of the
///               values, or a hundredth of the largest.
///
/// Rows that are held out and `gross` ones take no part in those differences. Throws InputError where all values are 0.
std::vector<NoiseSource> noise_sources(const experiment::Experiment& experiment, const std::vector<std::string>& tests,
                                       const plugins::Catalogue& catalogue, const std::vector<GrossRow>& gross = {});

/// The experiment in which every channel of the tests states that noise.
experiment::Experiment with_noise(experiment::Experiment experiment, const std::vector<std::string>& tests,
                                  const std::vector<NoiseSource>& sources);

/// Noise of the fitted rows as the fit has it: of a mean, where there are replicates. Rows left out as gross errors
/// have that of their neighbours, and not the one that silences them.
assembly::NoiseModel row_noise(const assembly::MeasuredChannel& view);
/// Its σ.
std::vector<double> row_deviations(const assembly::MeasuredChannel& view);

}  // namespace tunica::diagnosis
