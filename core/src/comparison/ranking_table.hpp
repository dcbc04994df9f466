// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "comparison/summary.hpp"

namespace tunica::comparison {

/// The comparison for a person, within 80 columns: warnings first, then the ranking, then each run's parameters with
/// confidence intervals and bound flags and its quality test by test, then what the data do not fix. Without control
/// characters, so that it can go to a file.
std::string ranking_table(const Summary& summary);

/// "22.386 ± 0.41 kPa", "22.386 (21.9 … 23.1) kPa" where the interval is not symmetric, "0.2033 (not fixed by the
/// data)".
std::string value_text(const Estimate& estimate);

}  // namespace tunica::comparison
