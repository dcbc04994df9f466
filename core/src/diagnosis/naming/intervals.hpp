// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/naming/explanation.hpp"

namespace tunica::diagnosis {

/// The causes of an explanation with 95 % intervals of the amplitudes of its extension from refits of data simulated
/// from it: percentiles of 199. As they are where fewer than 100 of them can be made, without an extension, or where
/// the diagnosis is quick.
Explanation with_refitted_intervals(const Inquiry& inquiry, const Analysis& analysis, Explanation explanation);

}  // namespace tunica::diagnosis
