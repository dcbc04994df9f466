// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tunica/detail/hyperelastic_part_batch.hpp"
#include "tunica/model.hpp"
#include "tunica/strip_path.hpp"

/// What Hyperelastic runs. The target tunica::sdk defines TUNICA_LINKED_KERNELS and links a library that holds these
/// functions, compiled once for all plugins. Without the definition each plugin compiles them itself, which takes a
/// model four times as long.
#ifdef TUNICA_LINKED_KERNELS
namespace tunica::hyperelastic {

/// Model::evaluate for a sum of parts, on the vector level of this library.
void evaluate_tensor(const Parts& parts, const MaterialPoints& points, const MaterialResponse& out);
/// Model::evaluate_axes for a sum of parts, likewise.
void evaluate_axes(const Parts& parts, const AxisPoints& points, const AxisResponse& out);
/// Model::solve_strip for a sum of parts. False where it has more of them than the strip has room for.
bool solve_strip_of_parts(const Model& model, const Parts& parts, const StripPath& strip, Status& status);

}  // namespace tunica::hyperelastic
#else
#define TUNICA_KERNEL inline
#include "tunica/detail/hyperelastic_kernels_here.hpp"
#endif
