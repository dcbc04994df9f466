// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/hypotheses/hypotheses.hpp"

#include "diagnosis/hypotheses/candidates.hpp"

namespace tunica::diagnosis {

Hypotheses hypotheses_of(const Inquiry& inquiry, const Evidence& evidence) {
  Hypotheses hypotheses;
  hypotheses.projection = Projection(interior(evidence.fit));
  hypotheses.candidates = candidates(inquiry, evidence, hypotheses.projection);
  hypotheses.directions = directions(hypotheses.candidates, hypotheses.projection);
  return hypotheses;
}

}  // namespace tunica::diagnosis
