// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "discovery/common/common_discovery.hpp"

namespace tunica::discovery {

/// Verdict, reasons, terms and ambiguity of several specimens of which `sets`, likeliest first, were fitted.
void settle(CommonDiscovery& found, const CommonFitter& fitter, std::vector<CommonFit> sets);

/// Where the alarms of all specimens together are silent.
void say_nothing_is_missing(CommonDiscovery& found);

}  // namespace tunica::discovery
