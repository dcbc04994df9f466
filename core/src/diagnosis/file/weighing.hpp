// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/naming/explanation.hpp"
#include "diagnosis/request.hpp"

namespace tunica::diagnosis {

/// The explanation beside what the file may say that is not so. Both are weighed by BIC with their priors:
///
///   S = |r|² + k ln n − 2 ln π
///
/// A mistake of the file has k = 0, or an amplitude and k = 1, and π = share of wrong files × its share among them. A
/// mechanism has its amplitude, k = 1, and an equal share of the rest. Where a mistake leaves noise and is ahead by
/// more than the margin, it is the verdict; within the margin it stands in the verdict as a question; else nothing
/// changes.
Explanation weighed_with_file(const Inquiry& inquiry, const Analysis& analysis, Explanation explanation);

}  // namespace tunica::diagnosis
