// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/naming/explanation.hpp"

namespace tunica::diagnosis {

/// Whether the base fit behaves as a material where it was measured: λ3 of strips falls, ellipticity holds.
Admissibility admissibility_of(const Evidence& evidence);

/// A fit that behaves as no material is a misfit of its own: the extensions by a mechanism of the model that fit as
/// well as the base and are admissible; of those with the fewest parameters the likeliest is named, others within
/// naming's set width are rivals. Without such an extension the verdict is unknown.
Explanation stabilised(const Inquiry& inquiry, const Analysis& analysis, const Admissibility& admissibility);

}  // namespace tunica::diagnosis
