// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "budget/budget.hpp"

namespace tunica::budget {

/// A discovery whose verdict is `leading` where its terms take nine tenths of the misfit and what they leave is no
/// noise. It says how much of the range that is. Throws as discovery::discover().
discovery::Discovery discover(const experiment::Experiment& experiment, const discovery::Request& request,
                              const plugins::Catalogue& catalogue, const diagnosis::Progress& progress = {});

}  // namespace tunica::budget
