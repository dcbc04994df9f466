// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

constexpr double gross_score = 16;  ///< of a row by itself, (r/σ)²

/// Rows with a score of their own above 16 (one in eighty data sets of 200 rows has such a one by chance), and more
/// than four standard deviations from the mean of their neighbours: a mechanism moves neighbours too. None where they
/// are more than one row in thirty, for then it is no matter of single rows.
std::vector<GrossRow> gross_rows(const Evidence& evidence);

/// The experiment in which these rows are gross: every fit leaves them out.
experiment::Experiment without_rows(experiment::Experiment experiment, const std::vector<GrossRow>& rows);

/// "row 14 of axial, stress (stretch 1.3, measured 14 kPa; +9.8 σ); …"
std::string words_of(const std::vector<GrossRow>& rows);

}  // namespace tunica::diagnosis
