// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tunica::data {

/// The known name that `found` was probably meant to be, or "" when none is near. Distance: optimal string alignment
/// (insertion, deletion, replacement, swap of neighbours), half a step for a change of case; near is at most two steps
/// and at most half the length.
std::string nearest(std::string_view found, const std::vector<std::string>& known);

/// "Did you mean 'kappa'? Known: mu, kappa, k1." – without the question when nothing is near.
std::string suggestion(std::string_view found, const std::vector<std::string>& known);

/// Text from a file as a message shows it: cut after 60 bytes (never within a UTF-8 character), control characters
/// as '?'.
std::string excerpt(std::string_view text);

}  // namespace tunica::data
