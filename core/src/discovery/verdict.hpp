// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "discovery/discovery.hpp"

namespace tunica::discovery {

/// Verdict, reasons, terms and ambiguity of a discovery of which `sets`, likeliest first, were fitted.
void settle(Discovery& found, const std::vector<SetFit>& sets);

/// The terms of a set with 95 % intervals, without their curves.
std::vector<FoundTerm> terms_of(const SetFit& best, const Judgement& judgement);

/// Where the calibrated alarm is silent: nothing is searched, and nothing is found.
Discovery nothing_missing(const Request& request, diagnosis::Analysis analysis);

}  // namespace tunica::discovery
