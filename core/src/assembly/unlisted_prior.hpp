// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

/// The prior of a smooth misfit of unlisted cause: δ = τ Σ_k √D_k b_k ψ_k over the shapes of a curve
/// (curve_shapes.hpp). ψ_k is scaled to the range of its channel, and b_k ~ N(0, 1). Size and roughness are
/// marginalised, not estimated.
namespace tunica::assembly::unlisted {

/// τ, as shares of the range; root mean squares.
constexpr std::array sizes{0.0025, 0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32};

/// ln of the weight of a size, up to a constant. No model follows real curves more closely than 1–3 % of their range; a
/// misfit ten times as large has a cause.
inline double log_weight(double size) {
  constexpr double usual_size = 0.02, spread = 0.7;  // spread: of ln τ
  return -0.5 * std::pow(std::log(size / usual_size) / spread, 2);
}

/// The decay of a kind of roughness with the degree k of a shape: (1 + k)⁻², (1 + k)⁻⁴, exp(−1.5 k), or flat up to a
/// degree, exp(−k²/2k₀²) with k₀ = 1.5, 3, 6. The flat kinds describe a misfit that is smooth over a part of the curve.
/// Without them, a wavy misfit would need a large τ, and any cause would then look like chance.
constexpr std::array<double (*)(double degree), 6> falls{
    [](double k) { return std::pow(1 + k, -2); },   [](double k) { return std::pow(1 + k, -4); },
    [](double k) { return std::exp(-1.5 * k); },    [](double k) { return std::exp(-std::pow(k / 1.5, 2) / 2); },
    [](double k) { return std::exp(-k * k / 18); }, [](double k) { return std::exp(-k * k / 72); }};

/// D_k of one kind of roughness for shapes up to a highest degree, such that τ is the root mean square of the misfit
/// over its curve: the mean square of ψ_k is 1/(2k + 1), and Σ D_k/(2k + 1) = 1.
class Variances {
 public:
  Variances(std::size_t roughness, unsigned highest) : fall_(falls[roughness]) {
    for (unsigned k = 0; k <= highest; ++k) mean_square_ += fall_(k) / (2.0 * k + 1);
  }
  [[nodiscard]] double of(double degree) const { return fall_(degree) / mean_square_; }

 private:
  double (*fall_)(double);
  double mean_square_ = 0;
};

}  // namespace tunica::assembly::unlisted
