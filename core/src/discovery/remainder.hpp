// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/detection/analysis.hpp"
#include "discovery/set_fit.hpp"

namespace tunica::discovery {

/// P-value of what a fit leaves, tested for smooth shapes and for all mechanisms, as a diagnosis tests it.
double p_of_rest(const diagnosis::Analysis& analysis, const diagnosis::Fit& fit);

}  // namespace tunica::discovery
