// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// P-value of what a refit leaves, tested like the residuals of the base fit among all that was not added: smooth
/// shapes and the other mechanisms. Of `outliers` that sit in a row, the other rows are tested still.
double p_of_rest(const Diagnosis& diagnosis, const Refitted& refitted, const Shapes& shapes,
                 const Eigen::MatrixXf& draws);

}  // namespace tunica::diagnosis
