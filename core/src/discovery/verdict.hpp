// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "discovery/discovery.hpp"

namespace tunica::discovery {

/// Verdict, reasons, terms and ambiguity of a discovery of which `sets`, likeliest first, were fitted.
void settle(Discovery& found, const std::vector<SetFit>& sets);

/// The terms of a set with 95 % intervals, without their curves.
std::vector<FoundTerm> terms_of(const SetFit& best, const Judgement& judgement);

/// Whether the noise of some channel is what the residuals say.
/// Whether what is left is within the tolerance, or up to half again as much.
bool is_small(const diagnosis::Evidence& evidence, const Request& request, const diagnosis::Fit& rest);

bool has_open_noise(const diagnosis::Evidence& evidence);

/// Where the calibrated alarm is silent: nothing is searched, and nothing is found.
Discovery nothing_missing(const Request& request, diagnosis::Analysis analysis);

}  // namespace tunica::discovery
