// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cohort/study.hpp"

namespace tunica::cohort {

/// result.json of a cohort, as schemas/tunica-cohort-result.schema.json says. Nothing in it depends on time or on who
/// made the records: the same bytes for any number of shards.
std::string study_json(const Specification& cohort, const SpecimenTable& table, const Collection& found,
                       const Study& study);

/// population.csv in long form: one row a number,
///
///   run, kind, of, unit, factor, group, estimate, lower, upper, freedom, p, p_holm, p_permutation, p_adjusted
///
/// `kind` is mean, spread or effect, of a parameter, or the same with "reading_" before it.
std::string population_table(const Study& study);

/// shrunken.csv: specimen, run, parameter, unit, estimate, lower, upper, borrowed.
std::string shrunken_table(const SpecimenTable& table, const Study& study);

/// band_<test>.csv: run, group, channel, <abscissa>, mean, lower, upper, one row a row of the group's first specimen.
void write_bands(const std::filesystem::path& folder, const Study& study);

/// The printed text about the population.
std::string study_words(const SpecimenTable& table, const Study& study);

}  // namespace tunica::cohort
