// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// Whether the base fit behaves as a material where it was measured: λ3 of strips falls, ellipticity holds.
void judge_admissibility(Diagnosis& diagnosis);

/// A fit that behaves as no material is a misfit of its own: the extensions by a mechanism of the model that fit as
/// well as the base and are admissible; of those with the fewest parameters the likeliest is named, others within
/// naming's set width are rivals.
void name_admissible_extension(Diagnosis& diagnosis, const plugins::Catalogue& catalogue);

}  // namespace tunica::diagnosis
