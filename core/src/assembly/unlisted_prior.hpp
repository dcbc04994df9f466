// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

/// What is believed, before the data, of a smooth misfit that nothing lists: δ = τ Σ_k √D_k b_k ψ_k over the shapes of
/// a curve (curve_shapes.hpp), ψ_k as high as the range of its channel, b_k ~ N(0, 1). Size and roughness are summed
/// over and not estimated.
namespace tunica::assembly::unlisted {

/// τ, as shares of the range.
constexpr std::array sizes{0.0025, 0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32};

/// ln of the weight of a size, up to a constant. No model follows real curves better than 1–3 % of their range; a
/// misfit of ten times as much has a cause.
inline double log_weight(double size) {
  constexpr double usual_size = 0.02, spread = 0.7;  // spread: of ln τ
  return -0.5 * std::pow(std::log(size / usual_size) / spread, 2);
}

constexpr int roughness_kinds = 3;

/// D_k of a shape of degree k: (1 + k)⁻², (1 + k)⁻⁴ or exp(−1.5 k).
inline double variance(int roughness, double degree) {
  if (roughness == 0) return std::pow(1 + degree, -2);
  return roughness == 1 ? std::pow(1 + degree, -4) : std::exp(-1.5 * degree);
}

}  // namespace tunica::assembly::unlisted
