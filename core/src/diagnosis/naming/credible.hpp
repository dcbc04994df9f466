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
/// The number of distinct explanations above which the cause is unknown.
constexpr std::size_t most_explanations = 4;

/// How much a candidate, wherever it acts, may look like what shows in this direction: the largest |ŝᵀ ŝ_h| over its
/// hypotheses h; 0 where it leaves no trace.
double likeness(const std::vector<Direction>& directions, std::size_t direction, std::size_t candidate);

/// Row a: the likeness of every candidate to candidate a in a's `best` direction, in which a explains these data best;
/// ones on the diagonal.
Eigen::MatrixXd likeness(const Hypotheses& hypotheses, const std::vector<std::optional<std::size_t>>& best);

/// The directions that act together: one, a pair, a triple.
using ActingTogether = std::vector<std::size_t>;

/// The class of each explanation by likeness, likeliest first. The first explanation of a class represents it. Another
/// belongs to the class if its members match the representative's members one to one. Two members match if they are the
/// same mechanism, or if one may look like the other. Classes are numbered in order of appearance.
std::vector<std::size_t> classes_of(const std::vector<Direction>& directions,
                                    const std::vector<ActingTogether>& explanations);

}  // namespace tunica::diagnosis
