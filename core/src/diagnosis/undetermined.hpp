// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// The experiment for the parameter that the data determine least; none where they determine all.
///
/// In u = ln p (scale log) or p/(max − min), J by u, and the box of the parameter file as a prior of its standard
/// deviation b, the data leave Σ = (JᵀJ + diag b⁻²)⁻¹, and n repeats of a design with Jacobian D make it
/// (JᵀJ + n DᵀD + diag b⁻²)⁻¹. A parameter counts as determined below sd 0.25 of ln p, or 0.1 of the box. Of the
/// library the design that gets there in the fewest repeats, up to 20; where none does, the one that comes nearest.
std::optional<NextExperiment> determining_experiment(const Diagnosis& diagnosis, const Refitted& model,
                                                     const plugins::Catalogue& catalogue);

/// The base fit, as a refit without additions.
Refitted bare(const Diagnosis& diagnosis, const plugins::Catalogue& catalogue);

}  // namespace tunica::diagnosis
