// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "tunica/model.hpp"

/// A compressible material point with some free faces. The squared stretches u_k along unit vectors d_k are not
/// prescribed, and no traction acts on these faces.
///
///     C = C₀ + Σ_k u_k d_k⊗d_k,   0 = r_k = ∂W/∂y_k = ½ u_k S_kk,   y_k = ln u_k,   S_kk = d_k·S d_k
///
/// C₀ has no entry along d_k, so that d_k is a principal direction. Dead faces make the equilibrium a minimum of W over
/// y: Newton's method with a line search on W, which κ/2 ln²J only helps, because ln J is linear in y.
/// Physics: docs/theory.md, compressible materials.
namespace tunica::free_faces {

template <class T>
using VectorOf = std::array<T, 3>;  ///< t, z, r
template <class T>
using TensorOf = std::array<T, 6>;  ///< tt, zz, rr, tz, zr, tr
using Tensor = TensorOf<double>;

/// a⊗b, symmetrised.
template <class T>
TensorOf<T> dyad(const VectorOf<T>& a, const VectorOf<T>& b) {
  return {a[0] * b[0],
          a[1] * b[1],
          a[2] * b[2],
          0.5 * (a[0] * b[1] + a[1] * b[0]),
          0.5 * (a[1] * b[2] + a[2] * b[1]),
          0.5 * (a[2] * b[0] + a[0] * b[2])};
}
/// A : B, off-diagonal entries of both count twice. For any type of number.
template <class A, class B>
auto contract(const A& a, const B& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}
/// det C, for any type of number.
template <class T>
T determinant(const TensorOf<T>& C) {
  return C[0] * (C[1] * C[2] - C[4] * C[4]) - C[3] * (C[3] * C[2] - C[4] * C[5]) + C[5] * (C[3] * C[4] - C[1] * C[5]);
}
/// C⁻¹, for any type of number.
template <class T>
TensorOf<T> inverse(const TensorOf<T>& C) {
  const T d = determinant(C);
  return {(C[1] * C[2] - C[4] * C[4]) / d, (C[0] * C[2] - C[5] * C[5]) / d, (C[0] * C[1] - C[3] * C[3]) / d,
          (C[4] * C[5] - C[3] * C[2]) / d, (C[3] * C[5] - C[0] * C[4]) / d, (C[3] * C[4] - C[1] * C[5]) / d};
}

/// Solves one point after another: solve(), then the derivatives of the solution. Its memory is reused between points.
class Point {
 public:
  /// d_k⊗d_k of no face or up to two, orthonormal. Model and parameters outlive the point.
  Point(const Model& model, std::span<const double> parameters, std::span<const Tensor> faces)
      : model_(model), parameters_(parameters), count_(faces.size()), stress_dp_(6 * parameters.size()) {
    std::copy(faces.begin(), faces.end(), faces_.begin());
  }

  /// Finds the equilibrium at `prescribed`, C₀. Newton's method begins at the solution before, first at rest, and steps
  /// from there to here are halved where it fails. `by_parameters`: whether ∂S/∂p is wanted too.
  Status solve(const Tensor& prescribed, bool by_parameters) {
    const Tensor from = has_begun_ ? prescribed_ : at_rest();
    const std::array<double, 2> first = u_;
    double reached = 0, step = 1;
    for (int trial = 0; trial < most_trials && reached < 1; ++trial) {
      const double next = std::min(1.0, reached + step);
      for (std::size_t c = 0; c < 6; ++c) prescribed_[c] = from[c] + next * (prescribed[c] - from[c]);
      const std::array<double, 2> before = u_;
      if (settle()) {
        reached = next;
        step *= 2;
      } else {
        u_ = before;
        step /= 4;
      }
    }
    if (reached < 1) {
      u_ = first;
      prescribed_ = from;
      if (count_ == 0)
        return Status::failed("the energy is undefined or overflows; narrow the bounds of the model's parameters");
      return Status::failed(
          "its free faces find no equilibrium, since the energy is undefined, overflows or has no minimum on the path "
          "from rest; "
          "narrow the "
          "bounds of the model's parameters");
    }
    prescribed_ = prescribed;
    has_begun_ = true;
    if (by_parameters)
      if (Status status = evaluate({}, {}, stress_dp_); !status.ok()) return status;
    relieve();
    return {};
  }

  [[nodiscard]] const Tensor& C() const { return C_; }
  /// S; across the first free face it is exactly zero.
  [[nodiscard]] const Tensor& stress() const { return stress_; }

  /// dC and dS along the solution where C₀ changes by `prescribed`, and d_k⊗d_k by `turned`.
  void follow(const Tensor& prescribed, std::span<const Tensor> turned, Tensor& dC, Tensor& dS) const {
    dC = prescribed;
    std::array<double, 2> on_faces{};
    for (std::size_t k = 0; k < turned.size(); ++k) {
      for (std::size_t c = 0; c < 6; ++c) dC[c] += u_[k] * turned[k][c];
      on_faces[k] = contract(turned[k], stress_);
    }
    respond(dC, dS);
    release(on_faces, dC, dS);
  }
  /// dC/dp_j and dS/dp_j along the solution.
  void by_parameter(std::size_t j, Tensor& dC, Tensor& dS) const {
    dC = {};
    std::copy_n(stress_dp_.begin() + static_cast<std::ptrdiff_t>(6 * j), 6, dS.begin());
    release({}, dC, dS);
  }

 private:
  static constexpr int most_steps = 40, most_trials = 200;
  static constexpr double last_step = 1e-8;  ///< of y; the remaining error is its square

  [[nodiscard]] Tensor at_rest() const {
    Tensor rest{1, 1, 1, 0, 0, 0};
    for (std::size_t k = 0; k < count_; ++k)
      for (std::size_t c = 0; c < 6; ++c) rest[c] -= faces_[k][c];
    return rest;
  }

  Status evaluate(std::span<double> energy, std::span<double> tangent, std::span<double> stress_dp) {
    C_ = prescribed_;
    for (std::size_t k = 0; k < count_; ++k)
      for (std::size_t c = 0; c < 6; ++c) C_[c] += u_[k] * faces_[k][c];
    return model_.evaluate({1, C_, parameters_, {}, {}}, {energy, stress_, tangent, stress_dp, {}});
  }

  /// Newton's method at the present C₀. False if it does not converge.
  bool settle() {
    double energy = 0;
    if (!evaluate({&energy, 1}, tangent_, {}).ok() || !sound(energy)) return false;
    for (int iteration = 0; iteration < most_steps; ++iteration) {
      if (count_ == 0) return true;
      const std::array<double, 2> step = newton();
      const double size = std::max(std::abs(step[0]), std::abs(step[1]));
      if (!(size < 1e3)) return false;
      const std::array<double, 2> before = u_;
      const double lowest = energy + 1e-13 * std::abs(energy);
      double share = std::min(1.0, 0.5 / size);
      for (int halving = 0;; ++halving, share /= 2) {
        for (std::size_t k = 0; k < count_; ++k) u_[k] = before[k] * std::exp(share * step[k]);
        const bool good = evaluate({&energy, 1}, tangent_, {}).ok() && sound(energy);
        if (good && (size < 1e-4 || energy <= lowest)) break;
        if (halving == 30) return false;
      }
      if (size < last_step) return true;
    }
    return false;
  }
  [[nodiscard]] bool sound(double energy) const {
    return std::isfinite(energy) &&
           std::all_of(stress_.begin(), stress_.end(), [](double s) { return std::isfinite(s); });
  }

  [[nodiscard]] Tensor row_of_tangent(std::size_t k) const {
    Tensor row{};
    for (std::size_t b = 0; b < 6; ++b) {
      Tensor column;
      for (std::size_t a = 0; a < 6; ++a) column[a] = tangent_[6 * a + b];
      row[b] = contract(faces_[k], column);
    }
    return row;
  }

  /// ∂²W/∂y_k∂y_l = ½ δ_kl u_k S_kk + ¼ u_k u_l d_k⊗d_k : 2 ∂S/∂C : d_l⊗d_l, made definite where it is not.
  [[nodiscard]] std::array<double, 2> newton() const {
    std::array<double, 2> r{}, diagonal{1, 1};
    double across = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      const Tensor row = row_of_tangent(k);
      r[k] = 0.5 * u_[k] * contract(faces_[k], stress_);
      diagonal[k] = r[k] + 0.25 * u_[k] * u_[k] * contract(row, faces_[k]);
      if (count_ == 2 && k == 0) across = 0.25 * u_[0] * u_[1] * contract(row, faces_[1]);
    }
    if (count_ == 1) return {-r[0] / std::max(std::abs(diagonal[0]), 1e-300), 0};
    const double mean = 0.5 * (diagonal[0] + diagonal[1]), half = 0.5 * (diagonal[0] - diagonal[1]);
    const double radius = std::hypot(half, across), smallest = mean - radius;
    if (!(smallest > 0)) {
      const double shift = 1e-3 * radius - smallest + 1e-300;
      diagonal[0] += shift;
      diagonal[1] += shift;
    }
    return solution(diagonal, across, {-r[0], -r[1]});
  }
  /// Of the symmetric 2 × 2 system, by elimination with the larger pivot.
  static std::array<double, 2> solution(const std::array<double, 2>& diagonal, double across,
                                        const std::array<double, 2>& right) {
    const std::size_t p = diagonal[0] >= diagonal[1] ? 0 : 1, q = 1 - p;
    const double ratio = across / diagonal[p], rest = diagonal[q] - ratio * across;
    std::array<double, 2> x{};
    x[q] = (right[q] - ratio * right[p]) / rest;
    x[p] = (right[p] - across * x[q]) / diagonal[p];
    return x;
  }

  /// dS += ½ (2 ∂S/∂C) : dC.
  void respond(const Tensor& dC, Tensor& dS) const {
    for (std::size_t a = 0; a < 6; ++a) dS[a] = 0.5 * contract(std::span(tangent_).subspan(6 * a, 6), dC);
  }
  /// Adds the part of the free stretches, for which d(S_kk) is zero; `on_faces` is what the turn of a face adds to it.
  void release(const std::array<double, 2>& on_faces, Tensor& dC, Tensor& dS) const {
    if (count_ == 0) return;
    std::array<double, 2> right{}, diagonal{1, 1};
    double across = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      const Tensor row = row_of_tangent(k);
      right[k] = -contract(faces_[k], dS) - on_faces[k];
      diagonal[k] = 0.5 * contract(row, faces_[k]);
      if (count_ == 2 && k == 0) across = 0.5 * contract(row, faces_[1]);
    }
    const std::array<double, 2> du = solution(diagonal, across, right);
    Tensor more{}, by_more;
    for (std::size_t k = 0; k < count_; ++k)
      for (std::size_t c = 0; c < 6; ++c) more[c] += du[k] * faces_[k][c];
    respond(more, by_more);
    for (std::size_t c = 0; c < 6; ++c) {
      dC[c] += more[c];
      dS[c] += by_more[c];
    }
  }

  /// Removes the pressure that rounding leaves on the first free face. In a nearly incompressible material it is large
  /// compared with the stress.
  void relieve() {
    if (count_ == 0) return;
    const Tensor inverse = free_faces::inverse(C_);
    const double left = contract(faces_[0], stress_) * u_[0];
    for (std::size_t c = 0; c < 6; ++c) stress_[c] -= left * inverse[c];
  }

  const Model& model_;
  std::span<const double> parameters_;
  std::size_t count_;
  std::array<Tensor, 2> faces_{};
  std::array<double, 2> u_{1, 1};
  bool has_begun_ = false;
  Tensor prescribed_{}, C_{}, stress_{};
  std::array<double, 36> tangent_{};
  std::vector<double> stress_dp_;
};

}  // namespace tunica::free_faces
