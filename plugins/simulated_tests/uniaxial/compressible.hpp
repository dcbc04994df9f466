// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "uniaxial.hpp"

namespace tunica::uniaxial {

/// The strip of a material that changes its volume: both lateral stretches follow from faces without traction.
///
///   C = λ1² e1⊗e1 + u2 e2⊗e2 + u3 e3⊗e3,   S22 = S33 = 0,   σ = λ1² S11/J,  P = λ1 S11
///
/// e1 is the strip's axis, turned in the wall's plane by `turn` and the misalignment or, if `radial`, the wall's
/// normal; the grips prevent shear. A channel of stretch is √u2 or √u3; volume ratio J = √det C.
Status predict_compressible(const Strip& strip, bool radial, const TestInput& input, const TestOutput& output);

}  // namespace tunica::uniaxial
