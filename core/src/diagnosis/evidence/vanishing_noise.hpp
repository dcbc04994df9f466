// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// Warns of channels with purely relative noise if the rows near zero (σ below 0.3 of the channel's median) carry most
/// of |r|², and more than 3 per row near zero. No instrument reads zero without error, so the misfit there may not be
/// real.
std::optional<Warning> vanishing_noise_warning(const Evidence& evidence);

}  // namespace tunica::diagnosis
