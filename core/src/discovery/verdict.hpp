// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "discovery/discovery.hpp"

namespace tunica::discovery {

/// Verdict, reasons, terms and ambiguity of a discovery of which `sets`, likeliest first, were fitted.
///
/// Terms and errors of the rig compete by their evidence, and so does memory; mechanisms that change the energy do not:
/// they are names for the same thing, and stand beside the terms. The ambiguity set holds 92.5 % of the probability.
void judge(Discovery& found, const std::vector<SetFit>& sets);

/// Where the calibrated alarm is silent: nothing is searched, and nothing is found.
Discovery nothing_missing(const Request& request, diagnosis::Analysis analysis);

/// "I2 (linear)", "fibre diagonal (exponential_square) and I2 (linear)"
std::string words_of(const std::vector<KindPointer>& kinds);

}  // namespace tunica::discovery
