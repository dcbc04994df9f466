// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// Refits the parameters with the additions, from what the linearisation says and from a smaller amplitude; none where
/// neither can be evaluated. `amplitudes` are differences from the nulls (even: squares). With `from`, a refit with all
/// additions but the last, first from where that one ended.
std::optional<Refitted> fit_with(const Diagnosis& diagnosis, std::vector<Addition> additions,
                                 std::span<const double> amplitudes, const plugins::Catalogue& catalogue,
                                 const Refitted* from = nullptr);

}  // namespace tunica::diagnosis
