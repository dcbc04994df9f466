// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/naming/explanation.hpp"

namespace tunica::diagnosis {

/// The differences between a run of extended.json and the diagnosis: relative noise, which a run takes of the measured
/// values, and gross rows beyond the first of a test.
std::vector<Warning> extended_run_warnings(const Inquiry& inquiry, const Evidence& evidence,
                                           const Explanation& explanation);

}  // namespace tunica::diagnosis
