// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// The curves whose smooth misfit is significant at the level alpha, shared out among the curves (Holm), the worst
/// first; where on them, and on which side. Where none is by itself, and the alarm has a cause, the curve of which that
/// explains most. Descriptive: the alarm is Detection's.
std::vector<Misfit> misfits(const Diagnosis& diagnosis);

}  // namespace tunica::diagnosis
