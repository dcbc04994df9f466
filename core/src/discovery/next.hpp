// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "discovery/discovery.hpp"

namespace tunica::discovery {

/// The experiment that would tell the best set from those that are about as likely: of other invariants first, of other
/// forms where there are none. Empty where there is one set only.
std::string next_experiment(const diagnosis::Inquiry& inquiry, const Discovery& found, const std::vector<SetFit>& sets);

}  // namespace tunica::discovery
