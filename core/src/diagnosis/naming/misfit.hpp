// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/naming/claims.hpp"

namespace tunica::diagnosis {

/// The curves whose smooth misfit is significant at the level alpha, shared out among the curves (Holm), the worst
/// first; where on them, and on which side. Where none is by itself, and the alarm has a cause, the curve of which that
/// explains most. Descriptive: the alarm is Detector's.
std::vector<Misfit> misfits(const Inquiry& inquiry, const Analysis& analysis, const Claim& claim);

}  // namespace tunica::diagnosis
