// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "text/escaped.hpp"

namespace tunica::data {

/// The known name that `found` was probably meant to be, or "" when none is near. Distance: optimal string alignment
/// (insertion, deletion, replacement, swap of neighbours), half a step for a change of case; near is at most two steps
/// and at most half the length.
std::string nearest(std::string_view found, const std::vector<std::string>& known);

/// "Did you mean 'kappa'? Known: mu, kappa, k1." – without the question when nothing is near, and at most the first
/// hundred names.
std::string suggestion(std::string_view found, const std::vector<std::string>& known);

using text::excerpt;

}  // namespace tunica::data
