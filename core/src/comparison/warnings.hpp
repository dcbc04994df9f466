// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "comparison/summary.hpp"
#include "execution/warning.hpp"

namespace tunica::comparison {

/// The warnings about these runs, the gravest first: runs without a result, broken constraints, noise that the misfit
/// contradicts, parameters at their bounds, failed evaluations, stops that gave up determinism, runs that cannot be
/// compared.
std::vector<execution::Warning> warnings_of(const execution::Plan& plan, const std::vector<RunSummary>& runs,
                                            const std::vector<Ranked>& ranking);

}  // namespace tunica::comparison
