// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "assembly/layout.hpp"
#include "cohort/likelihood.hpp"

namespace tunica::cohort {

/// A reading of the curve of one channel over its first abscissa x, on the rows from the first to the turn of the
/// loading, with straight lines between them:
///
///   at x:              y(x)
///   slope [x1, x2]:    (y(x2) − y(x1))/(x2 − x1)
///   integral [x1, x2]: ∫ y dx from x1 to x2 (trapezoids)
///
/// All three are linear in the predictions. The reading has a problem where the rows do not reach so far. Throws
/// InputError where an abscissa has another unit.
LinearReading read_off(const assembly::MeasuredChannel& channel, const ReadingEntry& entry);

}  // namespace tunica::cohort
