// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace tunica {

/// One step of one material point along its loading path in principal axes, with derivatives carried forward.
///
/// Every quantity is a row of `width` doubles: its value, then its derivatives by `width` − 1 directions. A direction
/// is any variable of differentiation: an unknown of the row, or a parameter of the model. Derivatives are total: those
/// of the state include the effect of a direction on all earlier rows. One pass along the path therefore gives exact
/// derivatives by all parameters (forward mode).
///
/// The caller fills in the elastic response. Model::remember() changes `gradient` and `state` in place.
/// Ownership: the caller's; pointers are valid during the call.
struct AxisStep {
  /// 1 + number of directions.
  std::size_t width = 1;
  /// Place in a row of the derivative by the first parameter of the model; those by the others follow. 0 = none.
  std::size_t parameter_place = 0;
  /// The parameters of the model, in the order and base units of the description.
  std::span<const double> parameters = {};
  /// Time since the previous step, in s, ≥ 0; read only if `timed`.
  double time_step = 0;
  /// Whether the rows have a clock. Without one, loading is infinitely slow.
  bool timed = false;
  /// The call before the first row, at c = (1, 1, 1): it sets the state up, and `gradient` is not read afterwards.
  bool at_rest = false;
  /// The first row of the path: there is no earlier loading.
  bool first = false;
  /// 3 rows: squared stretches c_t, c_z, c_r.
  const double* c = nullptr;
  /// 1 row: energy W of the elastic model, kPa.
  const double* energy = nullptr;
  /// 3 rows: g_a = ½ S_aa, kPa; before the call of the elastic model, after it with memory.
  double* gradient = nullptr;
  /// axis_history_size rows: the state after the previous step before the call, and the new state after it.
  double* state = nullptr;
};

}  // namespace tunica
