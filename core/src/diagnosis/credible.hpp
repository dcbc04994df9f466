// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// The ambiguity set is a credible set: the likeliest explanations that hold this probability together.
constexpr double set_mass = 0.95;
/// Mechanisms are look-alikes on these data where projected signatures of theirs correlate by more (likeness()).
constexpr double look_alike = 0.9;
/// Explanations that do not look alike, beyond which the cause is unknown.
constexpr std::size_t most_explanations = 4;

/// The candidates that act together: one, a pair, a triple.
using Explanation = std::vector<std::size_t>;

/// Explanations by looks: the class of each. Two look alike where their members can be matched one to one so that each
/// is the same mechanism or its look-alike; and so do those that a chain of such joins. Classes are numbered in the
/// order in which they come.
std::vector<std::size_t> classes_of(const Diagnosis& diagnosis, const std::vector<Explanation>& explanations);

}  // namespace tunica::diagnosis
