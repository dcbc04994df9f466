// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tunica/model.hpp"

namespace tunica::diagnosis {

/// Whether the model has no directions of its own: for a rotation Q about no axis of the material,
///
///   S(Q C Qᵀ) = Q S(C) Qᵀ
///
/// at several C and the initial parameters, to rounding. It is measured and not declared, so it holds for any plugin
/// and for a model with mechanisms. A response that is not finite counts as one with directions.
bool is_isotropic(const Model& model);

}  // namespace tunica::diagnosis
