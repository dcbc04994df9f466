// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/evidence/projection.hpp"
#include "diagnosis/hypotheses/hypothesis.hpp"

namespace tunica::diagnosis {

/// Every mechanism that was asked for with all its places and settings, and its signatures at the base fit, where a
/// refit absorbs what `projection` says. Mechanisms side by side; the outcome does not depend on threads.
std::vector<Candidate> candidates(const Inquiry& inquiry, const Evidence& evidence, const Projection& projection);

}  // namespace tunica::diagnosis
