// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/naming/claims.hpp"

namespace tunica::diagnosis {

/// The curves whose smooth misfit is significant at the level alpha after Holm's correction, the worst first, with
/// region and sign. If no curve is significant and the alarm has a cause, the curve of which the cause explains most.
/// It only describes; Detector raises the alarm.
std::vector<Misfit> misfits(const Inquiry& inquiry, const Analysis& analysis, const Claim& claim);

}  // namespace tunica::diagnosis
