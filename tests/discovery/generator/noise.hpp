// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "refit.hpp"
#include "specimen.hpp"

namespace blind {

/// How the records are noisy, and what of it the experiment file states.
///   white      σ of a channel is constant and stated
///   relative   σ² = a² + (b y)², stated
///   quantised  white, then rounded to a step of about σ; stated σ² = σ² + step²/12
///   outliers   white, stated, but one row in a hundred has an error eight times as large on top
///   correlated like white, but correlated along the rows, ρ = 0.3, which nothing states
///   ar1        correlated along the rows, ρ = 0.3, four replicates; nothing is stated
///   none       no noise in the files, and that of `white` stated: to compare simulations
struct NoiseModel {
  std::string kind;
  std::vector<double> absolute, relative, step;  ///< of every channel
  double correlation = 0;
  std::size_t replicates = 1;

  /// Noise of the mean of the replicates about `truth`: what the data allow to know.
  [[nodiscard]] Noise about(const Protocol& protocol, std::span<const double> truth) const;
};

const std::vector<std::string>& noise_kinds();
NoiseModel draw_noise(const std::string& kind, const Specimen& specimen, std::mt19937_64& random);

/// One record a replicate, and the gross errors in them.
struct Records {
  std::vector<std::vector<double>> replicates;
  std::vector<GrossError> gross;
};
Records add_noise(const NoiseModel& model, const Protocol& protocol, std::span<const double> truth,
                  std::mt19937_64& random);

}  // namespace blind
