// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "tunica/model.hpp"

namespace tunica::fe {

/// The model at fixed parameters in an axisymmetric state without torsion: C has the components tt, zz, rr, zr. Gives
/// first and second derivatives of W by C_tt, C_zz, C_rr and by s = C_zr, both off-diagonal entries moving together.
///
/// Where every invariant is linear in C the energy does not see s: W is what the principal-axes path computes from the
/// diagonal alone, at a fifth of the price of full tensors.
class Material {
 public:
  static constexpr std::size_t firsts = 4;    ///< W_t, W_z, W_r, W_s
  static constexpr std::size_t seconds = 10;  ///< tt, zz, rr, tz, zr, tr, then ss, ts, zs, rs

  Material(const Model& model, std::span<const double> parameters);

  [[nodiscard]] std::size_t parameter_count() const { return parameters_.size(); }
  /// False: W_s and the second derivatives by s are zero and not written.
  [[nodiscard]] bool sees_shear() const { return !diagonal_; }

  /// n points; C: 4n, first: 4n, second: 10n, component-major; first_dp: n_p·4n, ∂first/∂p_j at [(4j + a)n + i]. An
  /// empty span means "not wanted".
  Status evaluate(std::size_t n, std::span<const double> C, std::span<double> first, std::span<double> second,
                  std::span<double> first_dp) const;

  /// W at n points; C as above.
  Status energy(std::size_t n, std::span<const double> C, std::span<double> energy) const;

 private:
  Status on_tensors(std::size_t n, std::span<const double> C, std::span<double> first, std::span<double> second,
                    std::span<double> first_dp) const;
  const Model& model_;
  std::span<const double> parameters_;
  bool diagonal_;
};

}  // namespace tunica::fe
