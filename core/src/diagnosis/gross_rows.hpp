// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// Rows with a score of their own above 16 (one in eighty data sets of 200 rows has such a one by chance), and more
/// than four standard deviations from the mean of their neighbours: a mechanism moves neighbours too. None where they
/// are more than one row in thirty, for then it is no matter of single rows.
std::vector<GrossRow> gross_rows(const Diagnosis& diagnosis);

/// Takes the rows out of what every fit sees, from the base fit on.
void leave_out(Diagnosis& diagnosis, const std::vector<GrossRow>& rows, const plugins::Catalogue& catalogue);

/// Of the rows that were left out, those that the extension misses by more than four standard deviations, too; all of
/// them without an extension.
std::vector<GrossRow> still_gross(const Diagnosis& diagnosis);

/// Of the rows that were left out, those that extended.json takes out too: a test takes one such mechanism, and where
/// it has none yet it is for the first.
std::vector<GrossRow> taken_out(const Diagnosis& diagnosis);

/// These rows as causes, beside those of the extension: how far each lies from what the extension predicts.
std::vector<Cause> causes_of_rows(const Diagnosis& diagnosis, const plugins::Catalogue& catalogue);

/// The verdict where nothing but gross rows is wrong: suspect data, the cause `outliers` in the worst of them.
void name_gross_rows(Diagnosis& diagnosis, const std::vector<GrossRow>& rows, const plugins::Catalogue& catalogue);

}  // namespace tunica::diagnosis
