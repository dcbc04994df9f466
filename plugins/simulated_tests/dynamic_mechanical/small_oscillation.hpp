// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <complex>
#include <span>
#include <string>
#include <vector>

#include "tunica/model.hpp"

namespace tunica::dynamic_mechanical {

using Tensor = std::array<double, 6>;  ///< tt, zz, rr, tz, zr, tr
using ComplexTensor = std::array<std::complex<double>, 6>;

/// A material point at rest in a deformed state, and what small oscillations about it do.
///
/// The state is reached infinitely slowly. One step of the model from it, Δt long, is linear in small changes of the
/// state s before it and of C,
///
///     s₊ = P s + Q δC,   δS = R s + T δC,
///
/// with T = ∂S/∂C of the step and P, Q, R by differences. Oscillation at ω asks for s₊ = z s with z = e^{iωΔt}:
///
///     δS = [T + R (z 1 − P)⁻¹ Q] δC.
///
/// Models interpolate over a step, which leaves an error of (ωΔt)²; Δt is 3e-5/ω unless ωΔt is stated. For a Prony
/// series this is δS = [A + Σ g_k iωτ_k/(1 + iωτ_k) A'] δC (Ferry, Viscoelastic Properties of Polymers, 1980, chapter
/// 3).
class SmallOscillation {
 public:
  static constexpr double short_part = 3e-5;  ///< ωΔt
  /// Model and parameters outlive this.
  SmallOscillation(const Model& model, std::span<const double> parameters) : model_(model), parameters_(parameters) {}

  /// Goes to C. False where the model fails or gives no numbers.
  bool settle(const Tensor& C);
  /// S of the equilibrium at C.
  [[nodiscard]] const Tensor& stress() const { return stress_; }
  /// The state of the model there.
  [[nodiscard]] const std::vector<double>& state() const { return state_; }
  [[nodiscard]] const Tensor& C() const { return C_; }
  /// The slow change of S along dC.
  [[nodiscard]] Tensor slow_change(const Tensor& dC) const { return change(tangent_, dC); }
  /// The change of S in an oscillation of angular frequency ω along each of these directions. False as above, and where
  /// the response has two slopes.
  bool respond(double omega, std::span<const Tensor> directions, std::span<ComplexTensor> changes,
               double part = short_part) const;
  [[nodiscard]] const std::string& failure() const { return failure_; }
  /// Whether the last response had one slope forwards and another backwards, which its memory alone makes: softening by
  /// the largest load so far does, and the static state is that load.
  [[nodiscard]] bool has_two_slopes() const { return two_slopes_; }

  /// dS = ½ (2 ∂S/∂C) : dC
  static Tensor change(const std::array<double, 36>& tangent, const Tensor& dC);

 private:
  bool fails(const Status& status) const;
  [[nodiscard]] bool bends_without_memory(std::span<const double> C, std::size_t first, std::size_t count) const;

  const Model& model_;
  std::span<const double> parameters_;
  Tensor C_{}, stress_{};
  std::array<double, 36> tangent_{};
  std::vector<double> state_;
  mutable std::string failure_;
  mutable bool two_slopes_ = false;
};

}  // namespace tunica::dynamic_mechanical
