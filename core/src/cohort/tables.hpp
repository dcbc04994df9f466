// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cohort/collection.hpp"

namespace tunica::cohort {

/// What every table by specimen begins with: the id, then the other columns of the table of specimens, a comma behind
/// each. The header, and one specimen's.
std::string column_cells(const SpecimenTable& table);
std::string cells_of(const SpecimenTable& table, const Specimen& specimen);

/// parameters.csv in long form, for R and pandas: one row a specimen, run and parameter,
///
///   specimen, <column of the table> …, run, parameter, unit, estimate, lower, upper, at_bound, identified
///
/// in base units; an empty cell where there is nothing.
std::string parameter_table(const SpecimenTable& table, const Collection& found);

/// specimens.csv: one row a specimen and run,
///
///   specimen, <column of the table> …, folder, run, outcome, objective, least_r2, misfit, stable, warnings, reason
std::string specimen_table(const SpecimenTable& table, const Collection& found);

/// The printed text: the number of fitted specimens, and each unfitted one with its reason.
std::string outcome_words(const SpecimenTable& table, const Collection& found);

}  // namespace tunica::cohort
