// SPDX-License-Identifier: Apache-2.0
#include "discovery/remainder.hpp"

#include <algorithm>

#include "diagnosis/detection/squares.hpp"

namespace tunica::discovery {

double p_of_rest(const diagnosis::Analysis& analysis, const diagnosis::Fit& fit) {
  const diagnosis::Projection projection(diagnosis::interior(fit));
  const auto& candidates = analysis.hypotheses.candidates;
  const diagnosis::Detector detector(projection, diagnosis::directions(candidates, projection), candidates.size(),
                                     analysis.alarm.shapes, analysis.alarm.draws);
  return std::min(detector.test(-fit.residuals).p, diagnosis::p_of_squares(analysis.evidence, fit));
}

}  // namespace tunica::discovery
