// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cohort/collection.hpp"

namespace tunica::cohort {

/// parameters.csv in long form, for R and pandas: one row a specimen, run and parameter,
///
///   specimen, <column of the table> …, run, parameter, unit, estimate, lower, upper, at_bound, identified
///
/// in base units; an empty cell where there is nothing.
std::string parameter_table(const SpecimenTable& table, const Collection& found);

/// specimens.csv: one row a specimen and run,
///
///   specimen, folder, <column of the table> …, run, outcome, least_r2, misfit, stable, warnings, reason
std::string specimen_table(const SpecimenTable& table, const Collection& found);

/// What the program prints: how many were fitted, and each that was not with its reason.
std::string outcome_words(const SpecimenTable& table, const Collection& found);

}  // namespace tunica::cohort
