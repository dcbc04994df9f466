// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tunica/model.hpp"

namespace tunica::biaxial {

/// What the model says at C = diag(c_t, c_z, c_r) in the axes of the sheet: the normal components of S = 2 ∂W/∂C, of
/// its tangent and of its parameter derivatives, row by row. Scratch of one thread: it grows to the largest batch seen,
/// then allocates nothing.
struct Response {
  std::vector<double> c;          ///< 3n, set by the caller: component a of row i at [a·n + i]
  std::vector<double> shear;      ///< n; S_tz in the axes of the sheet, where these are turned
  std::vector<double> stress;     ///< 3n; S_aa
  std::vector<double> tangent;    ///< 6n; 2 ∂S_aa/∂C_bb in the order tt, zz, rr, tz, zr, tr
  std::vector<double> stress_dp;  ///< n_p·3n; ∂S_aa/∂p_j at [(3j + a)n + i]

  std::vector<double> factor;  ///< 2n; Cauchy stress in direction a to the data's measure at [a·n + i]

  struct Wants {
    bool tangent, parameters;
  };

  void reserve(std::size_t n, std::size_t parameters);
  /// Sets `factor` at the stretches c: λ_a^−power, with power 0, 1 or 2.
  void set_factors(std::size_t n, int power);
  /// Evaluates all n rows: in principal axes where the model offers that and the sheet is not turned, else over full
  /// tensors, in the rows' order. `time`: n clock readings, or empty. `angle`: as Sheet::angle.
  Status evaluate(const Model& model, std::span<const double> parameters, std::span<const double> time, std::size_t n,
                  double angle, Wants wants);

 private:
  Status on_axes(const Model& model, std::span<const double> parameters, std::size_t n, Wants wants);
  Status on_path(const Model& model, std::span<const double> parameters, std::span<const double> time, std::size_t n,
                 Wants wants);
  Status on_tensors(const Model& model, std::span<const double> parameters, std::span<const double> time, std::size_t n,
                    double angle, Wants wants);
  std::vector<double> tensor_, tensor_stress_, tensor_tangent_, tensor_stress_dp_, old_state_, new_state_;
};

}  // namespace tunica::biaxial
