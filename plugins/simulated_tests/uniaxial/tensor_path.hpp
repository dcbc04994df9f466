// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "uniaxial.hpp"

namespace tunica::uniaxial {

/// The free strip with any model: misaligned specimens, models with history, models without a principal-axes path.
/// Row by row in loading order, on the full tensors; the old state of a row is the new one of the row before.
///
/// Loading frame e1 (pulled), e2 (in-plane), r (normal), turned by the misalignment α from the material axes; the
/// grips prevent shear, so C = λ1² e1⊗e1 + u e2⊗e2 + 1/(λ1² u) r⊗r and σ12 ≠ 0 in general.
///   σ11 = λ1² S11 − λ3² S33,   0 = r = u S22 − λ3² S33
Status predict_on_tensors(const Strip& strip, const TestInput& input, double misalignment, const TestOutput& output);

}  // namespace tunica::uniaxial
