// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "comparison/summary.hpp"

namespace tunica::comparison {

const char* name_of(experiment::ObjectiveType type);

/// Runs of one group have the same objective on the same tests: only their objectives can be compared.
std::string group_of(const experiment::RunEntry& run);

/// All runs of the group, of which there are several, stop at the same target.
bool ranked_by_success(const std::vector<RunSummary>& runs, const std::string& group);

/// Within a group by objective; objectives within 1e-6 of each other share a rank, in the order of their
/// cost, then of the file; where all its runs stop at one target by success rate, then by expected running time. Then
/// the points that break a constraint, by violation; then those whose objective a fresh process did not find again;
/// then runs without a result.
std::vector<Ranked> rank(const std::vector<RunSummary>& runs);

/// Why a run does not count, or comes behind those that do; empty of one that is as it should be.
std::string reason_of_rank(const RunSummary& run);

/// Where runs of a group fit different models: AICc above the least of the group.
void compare_information(const std::vector<RunSummary>& runs, std::vector<Ranked>& ranking);

/// After that: a warning where the first of a group has so many parameters that AICc clearly prefers another model. The
/// order stays that of the objectives.
std::vector<execution::Warning> preferences(const std::vector<RunSummary>& runs, const std::vector<Ranked>& ranking);

}  // namespace tunica::comparison
