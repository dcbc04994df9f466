// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace tunica {

/// The input and output of Model::solve_strip(): n rows of an incompressible strip under tension along a material axis,
/// with free lateral faces. The model solves the equilibrium of every row.
///
/// With l = ln λ1 and y = ln λ2² the squared stretches are c = (e^{2l}, e^y, e^{−2l−y}), and W(l, y) has the
/// derivatives
///
///     σ = ∂W/∂l,   0 = ∂W/∂y                                     (physics: docs/theory.md, uniaxial strip)
///
/// with σ the Cauchy stress along the strip. An empty span means "not wanted". Spans do not overlap.
///
/// Initial guesses: the test (free_strip::Start) supplies nodes and their guesses once for its rows. A model may ignore
/// them. The result must not depend on earlier calls.
/// Failure: a row without equilibrium fails the call, and `lost` is its index; a stress that overflows is written as it
/// is. Threads: a call reads and writes only this object.
/// Ownership: the caller's; everything is valid during the call.
struct StripPath {
  std::size_t loaded = 0;              ///< the axis it is pulled along: 0 = circumferential, 1 = axial
  std::span<const double> parameters;  ///< of the model
  std::span<const double> stretch;     ///< n entries: λ1

  /// Stretches at which the equilibrium is solved first and then interpolated to the rows: 8, or none.
  std::span<const double> nodes = {};
  std::span<const double> guesses = {};  ///< 2·nodes entries: two guesses of λ2² a node
  /// 2·nodes × `row_stride` entries: λ2² of row i begins as Σ_k w_ki u_k + v_ki u_k (1 + y_l,k), w_ki at
  /// [k·row_stride + i] and v_ki behind all of them.
  std::span<const double> interpolation = {};
  std::size_t row_stride = 0;  ///< n rounded up to whole vectors

  std::span<double> stress;             ///< n entries: σ, kPa
  std::span<double> lateral = {};       ///< n entries: y
  std::span<double> stress_dp = {};     ///< n_p·n entries: dσ/dp_j of row i at [j·n + i], y in equilibrium
  std::span<double> lateral_dp = {};    ///< n_p·n entries: dy/dp_j; wanted only together with stress_dp
  std::span<double> stress_by_l = {};   ///< n entries: dσ/dl along the free path
  std::span<double> lateral_by_l = {};  ///< n entries: dy/dl; wanted only together with stress_by_l
  std::size_t* lost = nullptr;          ///< out: the row without equilibrium, if that is the failure

  /// No row.
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
};

}  // namespace tunica
