// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// What explains the residuals of the base fit: fills causes, ambiguity set, alternatives, verdict and extension.
///
/// The ambiguity set holds the likeliest explanations, with 95 % of the probability together, look-alikes counted once
/// (credible.hpp). Pairs are tried beside single mechanisms (groups.hpp), and a third where the best pair leaves
/// something; where no explanation leaves clean residuals, or too many do, the cause is unknown.
void name_causes(Diagnosis& diagnosis, const Detection& detection, const Eigen::MatrixXf& draws, const Shapes& shapes,
                 const plugins::Catalogue& catalogue);

}  // namespace tunica::diagnosis
