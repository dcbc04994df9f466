// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "comparison/summary.hpp"

namespace tunica::comparison {

/// fit_<test>.csv: what was measured and what the best point of every run predicts, in base units, one row a run and a
/// measured row:
///
///   run, <abscissa> [unit], <channel> [unit], <channel>.predicted [unit] …, held_out, <diagnostic> …,
///   <channel>.ci95 [unit], <channel>.lowest [unit], <channel>.highest [unit], <channel>.posterior_low [unit],
///   <channel>.posterior_median [unit], <channel>.posterior_high [unit], <channel>.measured_low [unit],
///   <channel>.measured_high [unit] …
///
/// `ci95` is the half width of the 95 % interval of the predicted curve, `lowest` and `highest` the range over the best
/// points of all realisations; `posterior_…` are 2.5, 50 and 97.5 % of the curve by draws from the posterior,
/// `measured_…` 2.5 and 97.5 % of what would be measured. These columns stand where some run has them.
///
/// All runs in one file, told apart by the column `run`: plotting tools group by it, and an experiment reads one of
/// them back with "where": {"run": "gho/es"}. What a run does not have is an empty cell.
std::string fit_table(const execution::Plan& plan, const Summary& summary, const std::string& test);

/// A test's name as part of a file's: what is no letter, digit, - or _ becomes -.
std::string file_stem(const std::string& test);

/// One file for every test that some run with a result used.
void write_fit_tables(const std::filesystem::path& directory, const execution::Plan& plan, const Summary& summary);

}  // namespace tunica::comparison
