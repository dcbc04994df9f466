// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "comparison/summary.hpp"
#include "text/styled.hpp"

namespace tunica::comparison {

/// The comparison for a person, within 80 columns: warnings first, then the ranking, then each run's parameters with
/// confidence intervals and bound flags and its quality test by test, then what the data do not fix.
text::StyledText ranking_table(const Summary& summary);

/// "22.386 ± 0.41 kPa", "22.386 kPa (21.9 … 23.1)" where the interval is not symmetric, "0.2033 (not fixed by the
/// data)", "5 kPa  <- at its upper bound".
text::StyledText value_text(const Estimate& estimate);

}  // namespace tunica::comparison
