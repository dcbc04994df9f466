// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// What explains the residuals of the base fit: fills causes, ambiguity set, alternatives, verdict and extension.
///
/// The ambiguity set holds the likeliest explanations, with 92.5 % of the probability together, look-alikes counted
/// once (credible.hpp). Pairs are tried beside single mechanisms (groups.hpp), and a third where the best pair leaves
/// something; where no explanation leaves clean residuals, or too many do, the cause is unknown.
void name_causes(Diagnosis& diagnosis, const Detection& detection, const Eigen::MatrixXf& draws, const Shapes& shapes,
                 const plugins::Catalogue& catalogue);

/// The verdict where the extension leaves what is no noise: unknown, with the share that the causes take, and how much
/// larger than it is said to be the noise would have to be for the rest to be clean. Where the alarm stands at that
/// noise too, the causes may be all there is.
void not_clean(Diagnosis& diagnosis, const Detection& detection, const Eigen::MatrixXf& draws, const Shapes& shapes);

}  // namespace tunica::diagnosis
