// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "discovery/common/common_fit.hpp"
#include "discovery/rivals.hpp"

namespace tunica::discovery {

/// Mechanisms as the only explanation of all specimens, each at its own place and amplitude, weighed as sets of terms
/// are; likeliest first. `base`: what the base says of each specimen.
std::vector<Rival> common_rivals(const std::vector<std::vector<Rival>>& of_specimens, const CommonFit& base);

}  // namespace tunica::discovery
