// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "comparison/summary.hpp"

namespace tunica::comparison {

/// Runs of one group have the same objective on the same tests: only their objectives can be compared.
std::string group_of(const experiment::RunEntry& run);

/// Within a group by objective, ties in the order of the file; then the points that break a constraint; then runs
/// without a result.
std::vector<Ranked> rank(const std::vector<RunSummary>& runs);

/// The share of realisations that came as far as the best known for the same model under the same conditions; fills
/// in threshold and success_rate.
void count_successes(const execution::Plan& plan, const std::vector<execution::RunResult>& results,
                     std::vector<RunSummary>& runs);

}  // namespace tunica::comparison
