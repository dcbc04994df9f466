// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnosis/naming/explanation.hpp"

namespace tunica::diagnosis {

/// Mutual look-alikes that also act over time, but were not considered because clock or order is unknown. For a drift
/// of a sensor those of the material in its tests, too, that some tests of this material could not show for that
/// reason. Empty for a mechanism without memory.
std::vector<std::string> unseen_rivals(const Inquiry& inquiry, const Analysis& analysis, const std::string& id,
                                       const Place& place);

Reason not_looked_for(const std::vector<std::string>& rivals);

/// A cause with such a rival cannot be named: the verdict becomes `indistinguishable`, and the rivals join the tie.
void limit_by_unseen_rivals(const Inquiry& inquiry, const Analysis& analysis, Explanation& explanation);

}  // namespace tunica::diagnosis
