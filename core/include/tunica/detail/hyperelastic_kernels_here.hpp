// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tunica/detail/hyperelastic_axes.hpp"
#include "tunica/detail/hyperelastic_tensor.hpp"
#include "tunica/detail/strip_of_parts.hpp"
#include "tunica/detail/strip_solver.hpp"

/// The bodies of the functions that hyperelastic_kernels.hpp declares. TUNICA_KERNEL: `inline`, or nothing in the
/// library that holds them.
namespace tunica::hyperelastic {

TUNICA_KERNEL void evaluate_tensor(const Parts& parts, const MaterialPoints& points, const MaterialResponse& out) {
  detail::vectorised([&parts, &points, &out] { evaluate_tensor_on_this_level(parts, points, out); });
}

TUNICA_KERNEL void evaluate_axes(const Parts& parts, const AxisPoints& points, const AxisResponse& out) {
  detail::vectorised([&parts, &points, &out] { evaluate_axes_on_this_level(parts, points, out); });
}

TUNICA_KERNEL bool solve_strip_of_parts(const Model& model, const Parts& parts, const StripPath& strip,
                                        Status& status) {
  if (parts.size() > StripOfParts::max_parts) return false;
  status = solve_strip<StripOfParts>(model, strip, parts, strip);
  return true;
}

}  // namespace tunica::hyperelastic
