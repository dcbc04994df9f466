// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/hypotheses/hypotheses.hpp"

#include "diagnosis/evidence/encompassing_noise.hpp"
#include "diagnosis/hypotheses/candidates.hpp"

namespace tunica::diagnosis {

Hypotheses hypotheses_of(const Inquiry& inquiry, const Evidence& evidence) {
  Hypotheses hypotheses;
  hypotheses.projection = Projection(interior(evidence.fit));
  hypotheses.candidates = candidates(inquiry, evidence, hypotheses.projection);
  hypotheses.directions = directions(hypotheses.candidates, hypotheses.projection);
  return hypotheses;
}

Hypotheses restated(const Hypotheses& hypotheses, const Evidence& before, const Evidence& after) {
  const Eigen::VectorXd scale = whitened_deviations(before).cwiseQuotient(whitened_deviations(after));
  Hypotheses found;
  found.projection = Projection(interior(after.fit));
  found.candidates = hypotheses.candidates;
  for (Candidate& candidate : found.candidates)
    for (Hypothesis& hypothesis : candidate.hypotheses)
      hypothesis.signature = scale.cwiseProduct(hypothesis.signature).eval();
  found.directions = directions(found.candidates, found.projection);
  return found;
}

std::vector<const Eigen::VectorXd*> visible_signatures(const Hypotheses& hypotheses) {
  std::vector<const Eigen::VectorXd*> found;
  for (const Direction& direction : hypotheses.directions)
    if (!direction.row) found.push_back(&hypotheses.hypothesis(direction).signature);
  return found;
}

}  // namespace tunica::diagnosis
