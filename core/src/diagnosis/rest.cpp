// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/rest.hpp"

#include <algorithm>
#include <vector>

#include "diagnosis/causes.hpp"
#include "diagnosis/squares.hpp"

namespace tunica::diagnosis {

double p_of_rest(const Diagnosis& d, const Refitted& refitted, const Shapes& shapes, const Eigen::MatrixXf& draws) {
  const Projection projection(interior(refitted.fit));
  std::vector<Candidate> others = d.candidates;
  for (Candidate& candidate : others)
    for (const Addition& addition : refitted.additions)
      if (candidate.id == addition.id)
        std::erase_if(candidate.hypotheses, [&](const Hypothesis& hypothesis) {
          return !addition.target.row || hypothesis.addition.target == addition.target;
        });
  const std::vector<Direction> directions_left = directions(others, projection);
  const Detection detection(projection, directions_left, others.size(), shapes, draws);
  return std::min(detection.judge(-refitted.fit.residuals).p, p_of_squares(d, refitted.fit));
}

}  // namespace tunica::diagnosis
