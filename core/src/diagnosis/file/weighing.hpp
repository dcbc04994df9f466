// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/naming/explanation.hpp"
#include "diagnosis/request.hpp"

namespace tunica::diagnosis {

/// Compares the explanation with possible mistakes in the file. Both are weighed by BIC with their priors:
///
///   S = |r|² + k ln n − 2 ln π
///
/// A mistake of the file has k = 0, or an amplitude and k = 1, and π = share of wrong files × its share among them. A
/// mechanism has its amplitude, k = 1, and an equal share of the rest. A mistake that leaves only noise and leads by
/// more than the margin is the verdict. Within the margin the verdict raises it as a question. Otherwise nothing
/// changes.
Explanation weighed_with_file(const Inquiry& inquiry, const Analysis& analysis, Explanation explanation);

}  // namespace tunica::diagnosis
