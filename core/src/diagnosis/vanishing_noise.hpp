// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// Warns of channels with purely relative noise where the rows near zero, σ below 0.3 of the channel's median, carry
/// most of an |r|² that is no noise (above 3 a row): no instrument reads zero to nothing, and what is called a misfit
/// there may be none.
void warn_of_vanishing_noise(Diagnosis& diagnosis);

}  // namespace tunica::diagnosis
