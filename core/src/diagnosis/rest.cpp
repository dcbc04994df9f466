// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/rest.hpp"

#include <algorithm>
#include <vector>

#include "diagnosis/causes.hpp"
#include "diagnosis/squares.hpp"

namespace tunica::diagnosis {

Rest::Rest(const Diagnosis& d, const Refitted& refitted, const Shapes& shapes, const Eigen::MatrixXf& draws)
    : others(d.candidates) {
  const Projection projection(interior(refitted.fit));
  for (Candidate& candidate : others)
    for (const Addition& addition : refitted.additions)
      if (candidate.id == addition.id)
        std::erase_if(candidate.hypotheses, [&](const Hypothesis& hypothesis) {
          return !addition.target.row || hypothesis.addition.target == addition.target;
        });
  directions = diagnosis::directions(others, projection);
  detection = std::make_unique<Detection>(projection, directions, others.size(), shapes, draws);
}

double p_of_rest(const Diagnosis& d, const Refitted& refitted, const Shapes& shapes, const Eigen::MatrixXf& draws) {
  const Rest rest(d, refitted, shapes, draws);
  return std::min(rest.detection->judge(-refitted.fit.residuals).p, p_of_squares(d, refitted.fit));
}

}  // namespace tunica::diagnosis
