// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "comparison/summary.hpp"
#include "execution/warning.hpp"

namespace tunica::comparison {

/// What nobody should overlook in these runs, the gravest first: noise that the misfit contradicts, runs
/// without a result, broken constraints, parameters
/// at their bounds, failed evaluations, stops that gave up determinism, runs that cannot be compared.
std::vector<execution::Warning> warnings_of(const execution::Plan& plan, const std::vector<RunSummary>& runs);

}  // namespace tunica::comparison
