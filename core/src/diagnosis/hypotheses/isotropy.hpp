// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tunica/model.hpp"

namespace tunica::diagnosis {

/// Whether the model is isotropic: for a rotation Q that is about no material axis,
///
///   S(Q C Qᵀ) = Q S(C) Qᵀ
///
/// at several C and the initial parameters, to rounding. It is computed and not declared, so it works for any plugin
/// and for a model with mechanisms. A non-finite response counts as anisotropic.
bool is_isotropic(const Model& model);

}  // namespace tunica::diagnosis
