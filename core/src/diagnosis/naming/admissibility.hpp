// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/naming/explanation.hpp"

namespace tunica::diagnosis {

/// Whether the base fit is a stable material in the measured range: λ3 of strips falls, and ellipticity holds.
Admissibility admissibility_of(const Evidence& evidence);

/// A fit that is no stable material counts as a misfit. Its explanations are the admissible extensions by a mechanism
/// of the model that fit as well as the base. Among those with the fewest parameters, the likeliest is named; others
/// within naming's set width are rivals. Without such an extension the verdict is unknown.
Explanation stabilised(const Inquiry& inquiry, const Analysis& analysis, const Admissibility& admissibility);

}  // namespace tunica::diagnosis
