// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "tunica/models/volume_energy.hpp"

namespace tunica {

/// The factor f of C̄ = f C with det C̄ = 1, at one point: f = J^(−2/3).
inline double isochoric_factor(const VolumeEnergy& volume) { return std::exp(-2 * volume.log_volume() / 3); }

/// Turns the response of W̄ at C̄ = f C into that of W(C) = W̄(f C), at point i of n. With S = f Dev S̄ and s = f S̄ : C,
///
///   2 ∂S/∂C = f² P : Ā : Pᵀ + ⅔ s (C⁻¹⊙C⁻¹ − ⅓ C⁻¹⊗C⁻¹) − ⅔ (C⁻¹⊗S + S⊗C⁻¹),   P = 1 − ⅓ C⁻¹⊗C,
///   Dev X = X − ⅓ (X : C) C⁻¹
///
/// (Flory 1961; Holzapfel 2000, Nonlinear Solid Mechanics, §6.4). `volume` is of this C. `response` holds S̄, wanted in
/// any case, and what else is wanted of tangent and derivatives by parameters; the energy is the same. Throws nothing.
inline void make_isochoric(const MaterialPoints& points, const VolumeEnergy& volume, const MaterialResponse& response,
                           std::size_t n, std::size_t i) {
  using Tensor = VolumeEnergy::Tensor;
  const double f = isochoric_factor(volume);
  const Tensor& inverse = volume.inverse();
  Tensor C;
  for (std::size_t k = 0; k < 6; ++k) C[k] = points.C[k * n + i];
  const auto deviator = [&](Tensor x) {
    const double mean = free_faces::contract(x, C) / 3;
    for (std::size_t k = 0; k < 6; ++k) x[k] -= mean * inverse[k];
    return x;
  };
  const auto project = [&](std::span<double> values, std::size_t first) {
    Tensor x;
    for (std::size_t k = 0; k < 6; ++k) x[k] = f * values[(first + k) * n + i];
    const Tensor dev = deviator(x);
    for (std::size_t k = 0; k < 6; ++k) values[(first + k) * n + i] = dev[k];
    return free_faces::contract(x, C);
  };
  const double s = project(response.stress, 0);
  for (std::size_t j = 0; 6 * j * n < response.stress_dp.size(); ++j) project(response.stress_dp, 6 * j);
  if (response.tangent.empty()) return;
  // Ā : Pᵀ row by row, then P : of the columns. Both are Dev with C⁻¹ and C.
  std::array<Tensor, 6> A;
  for (std::size_t a = 0; a < 6; ++a) {
    for (std::size_t b = 0; b < 6; ++b) A[a][b] = f * f * response.tangent[(6 * a + b) * n + i];
    A[a] = deviator(A[a]);
  }
  for (std::size_t b = 0; b < 6; ++b) {
    Tensor column;
    for (std::size_t a = 0; a < 6; ++a) column[a] = A[a][b];
    column = deviator(column);
    for (std::size_t a = 0; a < 6; ++a) {
      const double S_a = response.stress[a * n + i], S_b = response.stress[b * n + i];
      response.tangent[(6 * a + b) * n + i] = column[a] +
                                              2.0 / 3 * s * (volume.product(a, b) - inverse[a] * inverse[b] / 3) -
                                              2.0 / 3 * (inverse[a] * S_b + S_a * inverse[b]);
    }
  }
}

}  // namespace tunica
