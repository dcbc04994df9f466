// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/hypotheses/directions.hpp"

namespace tunica::diagnosis {

/// Possible faults, and their effect on the data.
struct Hypotheses {
  Projection projection;  ///< what a refit of the base model absorbs
  std::vector<Candidate> candidates;
  std::vector<Direction> directions;

  [[nodiscard]] const Hypothesis& hypothesis(const Direction& direction) const {
    return candidates[direction.candidate].hypotheses[direction.hypothesis];
  }
  [[nodiscard]] const Hypothesis& hypothesis(std::size_t direction) const { return hypothesis(directions[direction]); }
};

Hypotheses hypotheses_of(const Inquiry& inquiry, const Evidence& evidence);

/// The same hypotheses under another noise of the evidence: signatures in units of its σ, projected off its Jacobian.
Hypotheses restated(const Hypotheses& hypotheses, const Evidence& before, const Evidence& after);

/// Signatures of whole curves that a refit leaves something of.
std::vector<const Eigen::VectorXd*> visible_signatures(const Hypotheses& hypotheses);

}  // namespace tunica::diagnosis
