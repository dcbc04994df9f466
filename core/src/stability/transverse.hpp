// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "stability/axes_view.hpp"
#include "tunica/detail/free_strip.hpp"
#include "tunica/detail/strip_start.hpp"
#include "tunica/model.hpp"

/// Transverse stability (Canales et al., Mathematics 11:922, 2023; corrected, see docs/theory.md). On the equilibrium
/// path of a free strip along axis 1, normal 3,
///
///   Ψ = (λ3/λ2)²,   stable ⇔ dλ3/dλ1 ≤ 0 ⇔ dΨ/dλ1 ≤ 2Ψ/λ1;   with h ∈ [0, 1]:  c = (dΨ/dλ1) λ1/(2Ψ) − h ≤ 0.
///
/// With l = ln λ1 and y = ln λ2² on the path, λ3 = 1/(λ1 λ2):  ½ d ln Ψ/d ln λ1 = −1 − dy/dl,  so that
///
///   c = −1 − y' − h,   d ln λ3/d ln λ1 = −1 − y'/2,   y' = dy/dl by implicit differentiation of σ22 = 0.
namespace tunica::stability {

/// Where a strip stands at one stretch.
struct StripState {
  double stretch = 1, transverse = 1, normal = 1;  ///< λ1, λ2, λ3
  double stress = 0;                               ///< Cauchy stress along the strip, kPa
  double anisotropy = 1;                           ///< Ψ
  double slope = 0;                                ///< (dΨ/dλ1) λ1/(2Ψ): at most h where the criterion holds
  /// d ln λ3/d ln λ1 = (slope − 1)/2
  [[nodiscard]] double normal_slope() const { return (slope - 1) / 2; }
};

/// The free strip at fixed stretches. Const and thread-safe; refers to the model.
class FreePath {
 public:
  /// `axis`: the one pulled along, 0 = circumferential, 1 = axial. The slope at rest is the limit along the path, taken
  /// at a stretch of 1.0013: families that are slack there and taut at rest must not count.
  FreePath(const Model& model, std::size_t axis, std::vector<double> stretches);

  [[nodiscard]] std::size_t axis() const { return axis_; }
  [[nodiscard]] std::span<const double> stretches() const { return stretches_; }

  /// Of an isotropic material Ψ = 1 by symmetry, so that the slope is 0 whatever the parameters. Where this state is no
  /// minimum of W over the lateral stretch it is not stable, and the slope is given as 2.
  /// (dΨ/dλ1) λ1/(2Ψ) at every stretch and, unless empty, its derivative by the model's parameters, parameter j of
  /// stretch i at [j·n + i]. dy/dp is exact on the path; its derivative by l is taken by a five-point formula with a
  /// step of 5e-4, of error 1e-10 or less relative but for kinks, where a family switches. Where the model has no
  /// parameter derivatives, the slopes themselves are differenced.
  Status slopes(std::span<const double> parameters, std::span<double> slope, std::span<double> slope_dp) const;
  Status states(std::span<const double> parameters, std::span<StripState> states) const;

 private:
  /// All rows at their equilibria: what `path` wants of them.
  Status solve(StripPath path) const;
  Status mark_symmetric(const free_strip::Pull& pull, std::span<double> slope) const;
  Status solve_shifted(const free_strip::Pull& pull, std::span<const double> stretch, std::span<double> u) const;
  /// "axial strip at stretch 1.2"
  [[nodiscard]] std::string strip_at(std::size_t row) const;
  Status difference(std::span<const double> parameters, std::span<double> slope_dp) const;

  AxesView view_;
  std::size_t axis_;
  std::vector<double> stretches_, at_;  ///< as asked for; where they are evaluated
  free_strip::Start start_;
};

/// The result of the criterion (h = 1) in one direction. "Judged" are the measured or requested stretches.
struct TransverseVerdict {
  std::size_t axis = 0;
  double judged_from = 1, judged_to = 1;  ///< least and largest judged stretch; 1 = none on that side of rest
  std::optional<bool> stable;             ///< at every judged one; none without any, or without an answer at some
  std::optional<double> first_unstable;   ///< stretch from which λ3 grows, judged or not
  std::optional<double> stable_again;     ///< and where it stops growing, when it does below checked_to
  std::optional<double> first_unstable_pressed;  ///< stretch below which λ3 falls as the strip is pressed
  double checked_from = 1, checked_to = 1;       ///< the range in which the response was followed
  double worst_slope = 0;                        ///< largest d ln λ3/d ln λ1 between them

  [[nodiscard]] bool asked() const { return judged_from < 1 || judged_to > 1; }
};

/// Follows the path from rest to the stretch `limit`, and under compression to the least judged stretch, or as far as
/// there is an equilibrium.
TransverseVerdict judge_transverse(const Model& model, std::span<const double> parameters, std::size_t axis,
                                   const std::vector<double>& judged, double limit);

}  // namespace tunica::stability
