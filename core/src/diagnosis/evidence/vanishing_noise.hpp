// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// Warns of channels with purely relative noise where the rows near zero, σ below 0.3 of the channel's median, carry
/// most of an |r|² that is no noise (above 3 a row): no instrument reads zero to nothing, and what is called a misfit
/// there may be none.
std::optional<Warning> vanishing_noise_warning(const Evidence& evidence);

}  // namespace tunica::diagnosis
