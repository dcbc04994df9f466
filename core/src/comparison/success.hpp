// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "comparison/summary.hpp"

namespace tunica::comparison {

/// Runs of one problem search for the same thing: same model, objective, tests and constraints. They may differ in
/// optimizer and budget.
std::string problem_of(const experiment::RunEntry& run);

/// Evaluations a realisation made until its best feasible objective was at or below the threshold; none when it never
/// was.
std::optional<std::uint64_t> evaluations_to(const execution::RealisationResult& realisation, double threshold);

/// Fills in the threshold of each run – its target, else what success_threshold makes of the best that any run found
/// for the same problem – and what follows from it: successes, evaluations to it, and the expected running time
///
///   ERT = (Σ_successes evaluations up to the threshold + Σ_failures all evaluations) / number of successes,
///
/// the mean number of evaluations until the first success when failed searches are started again (A. Auger, N. Hansen,
/// "Performance evaluation of an advanced local search evolutionary algorithm", CEC 2005, 1777).
void count_successes(const execution::Plan& plan, const std::vector<execution::RunResult>& results,
                     std::vector<RunSummary>& runs);

}  // namespace tunica::comparison
