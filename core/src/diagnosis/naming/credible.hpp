// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/hypotheses/hypotheses.hpp"

namespace tunica::diagnosis {

/// The ambiguity set is a credible set: the likeliest explanations that hold this probability together. On the
/// development cases of the blind benchmark such a set holds the truth in 98 of 100.
constexpr double set_mass = 0.925;
/// A mechanism looks like another on these data above this likeness.
constexpr double look_alike = 0.9;
/// Explanations that do not look alike, beyond which the cause is unknown.
constexpr std::size_t most_explanations = 4;

/// How much a candidate, wherever it acts, may look like what shows in this direction: the largest |ŝᵀ ŝ_h| over its
/// hypotheses h; 0 where it leaves no trace.
double likeness(const std::vector<Direction>& directions, std::size_t direction, std::size_t candidate);

/// Row a: how much every candidate may look like a as it explains these data best, in its `best` direction; ones on the
/// diagonal.
Eigen::MatrixXd likeness(const Hypotheses& hypotheses, const std::vector<std::optional<std::size_t>>& best);

/// The directions that act together: one, a pair, a triple.
using ActingTogether = std::vector<std::size_t>;

/// Explanations by looks, likeliest first: the class of each. The first of a class stands for it, and those belong to
/// it of which the members can be matched with its members one to one so that each is the same mechanism as its
/// partner, or one of the two may look like the other. Classes are numbered in the order in which they come.
std::vector<std::size_t> classes_of(const std::vector<Direction>& directions,
                                    const std::vector<ActingTogether>& explanations);

}  // namespace tunica::diagnosis
