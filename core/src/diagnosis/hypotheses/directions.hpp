// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/evidence/projection.hpp"
#include "diagnosis/hypotheses/hypothesis.hpp"

namespace tunica::diagnosis {

/// A projected signature: the part of an effect that remains after a refit of the other parameters.
struct Direction {
  std::size_t candidate = 0, hypothesis = 0;
  Eigen::VectorXd unit;  ///< s̃/|s̃|
  double length = 0;     ///< |s̃|
  double retained = 0;   ///< |s̃|/|s|
  MechanismFactory::Side side = MechanismFactory::Side::both;
  double sign = 1;   ///< of the amplitude where the score is positive
  bool row = false;  ///< of a single row
  double share = 1;  ///< prior share among the directions of its candidate
};

/// Signatures that a refit absorbs but for this share are invisible: 0/0 would decide about them.
constexpr double invisible = 1e-4;

/// Projected signatures of all hypotheses; those that are absorbed are left out. Prior shares: whole curves and single
/// rows of a candidate are two kinds of equal weight, however many rows there are, and the directions of a kind are
/// equal.
std::vector<Direction> directions(const std::vector<Candidate>& candidates, const Projection& projection);

/// T = (ŝᵀr)² of a direction and the amplitude ŝᵀr/|s̃|, with r = measured − predicted; one-sided where the mechanism
/// is.
struct Score {
  double T = 0, amplitude = 0;  ///< even: the square of the amplitude
};
Score score(const Direction& direction, const Eigen::VectorXd& residuals);

/// The factors of a hypothesis's weight besides exp(gain/2): its share within its candidate, and its sides.
double log_prior(const Direction& direction);

/// The direction of a candidate that is likeliest by its score; none where the candidate leaves no trace.
std::optional<std::size_t> likeliest_direction(const std::vector<Direction>& directions,
                                               const Eigen::VectorXd& residuals, std::size_t candidate);

}  // namespace tunica::diagnosis
