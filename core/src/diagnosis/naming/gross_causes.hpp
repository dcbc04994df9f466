// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/naming/explanation.hpp"

namespace tunica::diagnosis {

/// The verdict where nothing but gross rows is wrong: suspect data, the cause `outliers` in the worst of them.
Explanation suspected_rows(const Inquiry& inquiry, const Analysis& analysis, const std::vector<GrossRow>& rows);

/// Of the rows that were left out, those that the extension misses by more than four standard deviations, too; all of
/// them without an extension.
std::vector<GrossRow> still_gross(const Analysis& analysis, const Claim& claim);

/// Of the rows that were left out, those that extended.json takes out too, as causes beside those of the extension: how
/// far each lies from what the extension predicts. A test takes one such mechanism, and where it has none yet it is for
/// the first row.
std::vector<Cause> causes_of_rows(const Inquiry& inquiry, const Analysis& analysis, const Claim& claim);

}  // namespace tunica::diagnosis
