// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// Warns of channels whose residuals are smaller than their noise allows: their σ is too large, and an effect below it
/// cannot be seen. With n rows, of which the fit absorbs q = Σ |row of Q|², and ν degrees of freedom of σ̂²,
///
///   |r|²/(n − q) ~ F(n − q, ν),  ν = ∞ where σ is known;
///
/// the warning names a channel where its lower tail is below 1 %, shared out among the channels.
std::optional<Warning> large_noise_warning(const Evidence& evidence, const Fit& best);

}  // namespace tunica::diagnosis
