// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <string>

#include "assembly/assembly.hpp"

namespace tunica::assembly {

/// Misfit of this size and above matters: χ² per degree of freedom.
constexpr double noticeable_misfit = 1.5;
/// Misfit below this is too small: the rows scatter by less than a third of the noise.
constexpr double little_misfit = 0.1;
/// Probability that a correct model is reported to contradict its noise.
constexpr double misfit_false_alarm = 1e-3;

/// How far a model misses the data, in units of their noise:
///
///   χ² = Σ r²,   r = (e_k/σ_k − φ e_{k−1}/σ_{k−1})/√(1 − φ²),   ν = n (1 − p/N)
///
/// over the n of all N fitted rows with one kind of noise; each of the p free parameters uses one degree of freedom.
struct Misfit {
  double chi_square = 0;
  std::size_t rows = 0;      ///< n
  double freedom = 0;        ///< ν; 0 or less: as many parameters as rows, no statement
  double chance = 1;         ///< of so large a χ² under a correct model with this noise
  double noise_freedom = 0;  ///< of an estimated σ; 0: stated

  [[nodiscard]] bool judged() const { return rows > 0 && freedom > 0; }
  [[nodiscard]] double per_freedom() const { return chi_square / freedom; }
  /// √(χ²/ν): how many times the noise.
  [[nodiscard]] double times() const;
  /// The rows contradict model and noise together: `chance` below misfit_false_alarm, and a misfit that matters.
  [[nodiscard]] bool contradicts() const {
    return judged() && chance < misfit_false_alarm && per_freedom() > noticeable_misfit;
  }
  /// The rows contradict model and noise, but by a small amount: many rows detect even a small misfit.
  [[nodiscard]] bool small_but_real() const {
    return judged() && chance < misfit_false_alarm && !contradicts() && per_freedom() > 1;
  }
  /// √(χ²/ν − 1): the size of the misfit beyond noise, in units of the noise.
  [[nodiscard]] double systematic() const { return per_freedom() > 1 ? std::sqrt(per_freedom() - 1) : 0; }
  /// √(χ² − ν)/1.96: the largest error of a parameter, in half-widths of its interval, if all misfit acts along it.
  [[nodiscard]] double half_widths() const { return judged() ? systematic() * std::sqrt(freedom) / 1.96 : 0; }
  /// The rows scatter by less than the stated noise: so small a χ² has a probability below misfit_false_alarm, and the
  /// difference matters.
  [[nodiscard]] bool falls_short() const {
    return judged() && noise_freedom == 0 && 1 - chance < misfit_false_alarm && per_freedom() < little_misfit;
  }
};

/// "χ²/ν 8.97 (χ² 4538, ν 506), 3 times the stated noise: the model misses the data". `noise`: "stated", "estimated".
/// Runs, diagnoses and their tables describe a misfit in these words.
std::string in_words(const Misfit& misfit, const char* noise);

/// The misfit of rows whose χ² is known: `fitted` rows carry all `parameters`.
Misfit misfit_of(double chi_square, std::size_t rows, std::size_t fitted, std::size_t parameters,
                 double noise_freedom = 0);

/// The channels that count: those with stated noise, or those with noise estimated from the data. Neither: assumed σ.
enum class NoiseKind { stated, estimated };

/// Of the channels that count (weight > 0), at these predictions. `measured` in their layout stands in for the data
/// unless empty. The chance is that of χ² with ν degrees of freedom where the noise is stated; where it is estimated,
/// that of F with ν and the degrees of freedom of the estimates.
Misfit misfit(const Assembly& assembly, NoiseKind kind, std::span<const double> predictions,
              std::span<const double> measured = {});

}  // namespace tunica::assembly
