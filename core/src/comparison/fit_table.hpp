// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "comparison/summary.hpp"

namespace tunica::comparison {

/// fit_<test>.csv: what was measured and what the best point of every run predicts, in base units, one row a run and a
/// measured row:
///
///   run, <abscissa> [unit], <channel> [unit], <channel>.predicted [unit] …, held_out, <diagnostic> …
///
/// All runs in one file, told apart by the column `run`: plotting tools group by it, and an experiment reads one of
/// them back with "where": {"run": "gho/es"}. A diagnostic that a run's test does not have is an empty cell.
std::string fit_table(const execution::Plan& plan, const Summary& summary, const std::string& test);

/// One file for every test that some run with a result used.
void write_fit_tables(const std::filesystem::path& directory, const execution::Plan& plan, const Summary& summary);

}  // namespace tunica::comparison
