// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/naming/explanation.hpp"

namespace tunica::diagnosis {

/// What a run of extended.json takes otherwise than the diagnosis: relative noise, which is of the measured values
/// there, and gross rows beyond the first of a test.
std::vector<Warning> extended_run_warnings(const Inquiry& inquiry, const Evidence& evidence,
                                           const Explanation& explanation);

}  // namespace tunica::diagnosis
