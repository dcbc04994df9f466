// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// What the extension gains: |r|² in sample, beside what the best of all mechanisms gains under nothing and what the
/// best wrong one gains; and on blocks that take no part in the fit that predicts them: each test left out, each type
/// of test, and the rows beyond 70 % of the range of the abscissa predicted from those below. A test that alone shows
/// the effect cannot be predicted with it from the others, and is left out of the list.
///
/// With residuals r_H of a block at the refit, their Jacobian J_H and the covariance C of the parameters from the rest,
/// r_Hᵀ (I + J_H C J_Hᵀ)⁻¹ r_H ~ χ² of as many degrees of freedom as rows: the p-value.
void measure_gain(Diagnosis& diagnosis);

}  // namespace tunica::diagnosis
