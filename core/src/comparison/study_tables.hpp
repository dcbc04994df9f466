// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "comparison/summary.hpp"

namespace tunica::comparison {

/// The comparison as tables for plotting programs and statistics packages; comment lines begin with '#'.
///
///   ranking.csv              one row a run, in the order of the ranking, runs without a result among them
///   realisations.csv         one row a realisation: objective, parameters, evaluations, seconds, success
///   convergence.csv          best feasible objective over evaluations, thinned (the rule is in the file)
///   performance_profile.csv  share of problems solved over cost relative to the best optimizer (performance.hpp)
///   data_profile.csv         share of problems solved over evaluations
///
/// The last two are written when there is more than one realisation or problem.
std::string ranking_csv(const execution::Plan& plan, const Summary& summary);
std::string realisations_csv(const execution::Plan& plan, const std::vector<execution::RunResult>& results,
                             const Summary& summary);
/// statistics.csv: the statistics of result.json as a table.
std::string statistics_csv(const Summary& summary);
std::string convergence_csv(const std::vector<execution::RunResult>& results, const Summary& summary);
void write_study_tables(const std::filesystem::path& directory, const execution::Plan& plan,
                        const std::vector<execution::RunResult>& results, const Summary& summary);

}  // namespace tunica::comparison
