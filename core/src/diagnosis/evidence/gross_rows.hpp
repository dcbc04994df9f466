// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

constexpr double gross_score = 16;  ///< of a row by itself, (r/σ)²

/// Rows with a score above 16 that also lie more than four standard deviations from the mean of their neighbours. By
/// chance, one in eighty data sets of 200 rows has such a score. A mechanism would move the neighbours too. None if
/// they are more than one row in thirty, because the fault is then not in single rows.
std::vector<GrossRow> gross_rows(const Evidence& evidence);

/// The experiment in which these rows are gross: every fit leaves them out.
experiment::Experiment without_rows(experiment::Experiment experiment, const std::vector<GrossRow>& rows);

/// "row 14 of axial, stress (stretch 1.3, measured 14 kPa; +9.8 σ); …"
std::string words_of(const std::vector<GrossRow>& rows);

}  // namespace tunica::diagnosis
