// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "comparison/summary.hpp"
#include "execution/warning.hpp"
#include "plugins/calls.hpp"

namespace tunica::comparison {

/// Fills in what the best point of a run says: it is evaluated again, from nothing, and must give what the search
/// recorded (otherwise a warning); parameters with confidence intervals and bounds, quality of the fit per channel and
/// the size of its misfit, identifiability in words. At the deadline, intervals and the spread of realisations are left
/// out, and that is said; what the point itself says takes what it takes. `experiment`: what the assembly was made of.
void estimate(const experiment::Experiment& experiment, const assembly::Assembly& assembly,
              const execution::RealisationResult& best, const execution::RunResult& all, RunSummary& summary,
              std::vector<execution::Warning>& warnings,
              plugins::Clock::time_point deadline = plugins::Clock::time_point::max());

}  // namespace tunica::comparison
