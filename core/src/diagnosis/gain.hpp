// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// What the extension gains: |r|² in sample, beside what the best of all mechanisms gains under nothing and what the
/// best wrong one gains; and on blocks that take no part in the fit that predicts them: each test left out, each type
/// of test, and the rows beyond 70 % of the range of the abscissa predicted from those below. A test that alone shows
/// the effect cannot be predicted with it from the others, and is left out of the list.
///
/// The p-value of a block is Chow's: |r|² of all rows at the fit of all, less |r|² of the others at theirs, is χ² of as
/// many degrees of freedom as the block has rows.
void measure_gain(Diagnosis& diagnosis);

}  // namespace tunica::diagnosis
