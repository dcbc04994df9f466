// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace tunica::population {

/// p-values adjusted for their number, by S. Holm, Scand. J. Stat. 6:65 (1979): p_(k) (m − k + 1), rising, at most 1.
std::vector<double> holm(const std::vector<double>& p_values);

}  // namespace tunica::population
