// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/evidence/projection.hpp"
#include "diagnosis/hypotheses/hypothesis.hpp"

namespace tunica::diagnosis {

/// Every requested mechanism with all its places and settings, and its signatures at the base fit. A refit absorbs the
/// directions in `projection`. Mechanisms run in parallel; the outcome does not depend on the number of threads.
std::vector<Candidate> candidates(const Inquiry& inquiry, const Evidence& evidence, const Projection& projection);

}  // namespace tunica::diagnosis
