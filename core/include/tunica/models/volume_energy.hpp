// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "tunica/detail/free_faces.hpp"
#include "tunica/model.hpp"

namespace tunica {

/// An energy U(J) of the volume ratio alone, at one point, added to what a model has written. With θ = ln J:
///
///     S = U_θ C⁻¹,   2 ∂S/∂C = U_θθ C⁻¹⊗C⁻¹ − 2 U_θ C⁻¹⊙C⁻¹,   (C⁻¹⊙C⁻¹)_ijkl = ½ (C⁻¹_ik C⁻¹_jl + C⁻¹_il C⁻¹_jk)
///
/// (Holzapfel, Nonlinear Solid Mechanics, 2000, §6.5).
class VolumeEnergy {
 public:
  using Tensor = free_faces::Tensor;  ///< tt, zz, rr, tz, zr, tr

  /// Of this C, six components as MaterialPoints::C.
  explicit VolumeEnergy(const Tensor& C)
      : inverse_(free_faces::inverse(C)), theta_(0.5 * std::log(free_faces::determinant(C))) {}

  [[nodiscard]] double log_volume() const { return theta_; }        ///< θ
  [[nodiscard]] const Tensor& inverse() const { return inverse_; }  ///< C⁻¹

  /// Adds energy, stress and tangent to those of point i, where they are wanted.
  void add(double U, double by_theta, double by_theta_twice, const MaterialResponse& out, std::size_t n,
           std::size_t i) const {
    if (!out.energy.empty()) out.energy[i] += U;
    for (std::size_t c = 0; c < 6 && !out.stress.empty(); ++c) out.stress[c * n + i] += by_theta * inverse_[c];
    for (std::size_t a = 0; a < 6 && !out.tangent.empty(); ++a)
      for (std::size_t b = 0; b < 6; ++b)
        out.tangent[(6 * a + b) * n + i] += by_theta_twice * inverse_[a] * inverse_[b] - 2 * by_theta * product(a, b);
  }
  /// Adds ∂S/∂p_j where U_θ depends on the parameter like this.
  void add_parameter(std::size_t j, double by_theta_p, const MaterialResponse& out, std::size_t n,
                     std::size_t i) const {
    for (std::size_t c = 0; c < 6 && !out.stress_dp.empty(); ++c)
      out.stress_dp[(6 * j + c) * n + i] += by_theta_p * inverse_[c];
  }
  /// C⁻¹⊙C⁻¹ of two pairs of axes.
  [[nodiscard]] double product(std::size_t a, std::size_t b) const {
    const auto [i, j] = pair[a];
    const auto [k, l] = pair[b];
    return 0.5 * (inverse_[place[i][k]] * inverse_[place[j][l]] + inverse_[place[i][l]] * inverse_[place[j][k]]);
  }

 private:
  static constexpr std::array<std::array<std::size_t, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  static constexpr std::array<std::array<std::size_t, 3>, 3> place{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};

  Tensor inverse_;
  double theta_;
};

}  // namespace tunica
