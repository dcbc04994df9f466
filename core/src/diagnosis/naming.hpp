// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// What explains the residuals of the base fit: fills causes, ambiguity set, alternatives, verdict and extension.
///
/// The ambiguity set holds the candidates with 2 ln(w_best/w) ≤ set_width (singles.hpp). Residuals that stay after the
/// best one are tested like those of the base fit; where they are not clean, all pairs are tried (groups.hpp), then a
/// third; where they are not clean then, the cause is unknown.
void name_causes(Diagnosis& diagnosis, const Detection& detection, const Eigen::MatrixXf& draws, const Shapes& shapes,
                 const plugins::Catalogue& catalogue);

}  // namespace tunica::diagnosis
