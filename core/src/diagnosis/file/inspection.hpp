// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// What shows without a fit: blocks of rows that stand in a file twice, values on a coarse grid, signs, percent,
/// radians and times that no such test has; and words in the header of a column that say another stress or strain than
/// the file declares.
std::vector<Suspect> inspected(const Evidence& evidence);

}  // namespace tunica::diagnosis
