// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "comparison/summary.hpp"
#include "execution/warning.hpp"

namespace tunica::comparison {

/// Parameters of the run at a bound, a warning each.
void warn_of_bounds(const RunSummary& run, std::vector<execution::Warning>& warnings);

/// Searches that a default bound has ended say that a better point may lie beyond it, although another one won. One
/// warning tells of all bounds of the run.
void warn_of_default_bounds(const RunSummary& run, std::vector<execution::Warning>& warnings);

}  // namespace tunica::comparison
