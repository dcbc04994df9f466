// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// Mistakes that show without a fit: repeated blocks of rows, values on a coarse grid, and signs, percentages, radians
/// and times that are impossible in such a test. Also column headers that name another stress or strain than the file
/// declares.
std::vector<Suspect> inspected(const Evidence& evidence);

}  // namespace tunica::diagnosis
