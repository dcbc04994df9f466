// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnosis/naming/refits.hpp"

namespace tunica::diagnosis {

constexpr std::size_t most_repeats = 20;  ///< of a design

/// The experiment for the parameter that the data determine least; none where they determine all.
///
/// In u = ln p (scale log) or p/(max − min), J by u, and the box of the parameter file as a prior of its standard
/// deviation b, the data leave Σ = (JᵀJ + diag b⁻²)⁻¹, and n repeats of a design with Jacobian D make it
/// (JᵀJ + n DᵀD + diag b⁻²)⁻¹. A parameter counts as determined below sd 0.25 of ln p, or 0.1 of the box. Of the
/// library the design that gets there in the fewest repeats, up to 20; where none does, the one that comes nearest.
std::optional<NextExperiment> determining_experiment(const Inquiry& inquiry, const Evidence& evidence,
                                                     const Refit& model);

/// The base fit, as a refit without additions.
Refit bare_refit(const Inquiry& inquiry, const Evidence& evidence);

}  // namespace tunica::diagnosis
