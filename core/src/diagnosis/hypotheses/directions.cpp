// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/hypotheses/directions.hpp"

#include <cmath>
#include <map>
#include <utility>

namespace tunica::diagnosis {

std::vector<Direction> directions(const std::vector<Candidate>& candidates, const Projection& projection) {
  std::vector<Direction> found;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (std::size_t h = 0; h < candidates[c].hypotheses.size(); ++h) {
      const Eigen::VectorXd& s = candidates[c].hypotheses[h].signature;
      const Eigen::VectorXd left = projection.off(s);
      const double length = left.norm(), retained = length / s.norm();
      if (!(retained > invisible)) continue;
      const Hypothesis& hypothesis = candidates[c].hypotheses[h];
      found.push_back({c, h, left / length, length, retained, hypothesis.side, hypothesis.sign,
                       hypothesis.addition.place.row.has_value()});
    }
  std::map<std::pair<std::size_t, bool>, std::size_t> alike;  // of a candidate and kind
  for (const Direction& direction : found) ++alike[{direction.candidate, direction.row}];
  for (Direction& direction : found) {
    const bool both_kinds = alike.contains({direction.candidate, !direction.row});
    direction.share = (both_kinds ? 0.5 : 1.0) / static_cast<double>(alike[{direction.candidate, direction.row}]);
  }
  return found;
}

Score score(const Direction& direction, const Eigen::VectorXd& residuals) {
  const double t = direction.unit.dot(residuals);
  if (direction.side != MechanismFactory::Side::both && t < 0) return {0, 0};
  return {t * t, direction.sign * t / direction.length};
}

double log_prior(const Direction& direction) {
  return std::log(direction.share) + (direction.side == MechanismFactory::Side::both ? 0 : std::log(2.0));
}

std::optional<std::size_t> likeliest_direction(const std::vector<Direction>& directions,
                                               const Eigen::VectorXd& residuals, std::size_t candidate) {
  std::optional<std::size_t> best;
  double most = -INFINITY;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    if (directions[k].candidate != candidate) continue;
    const double log_weight = score(directions[k], residuals).T / 2 + log_prior(directions[k]);
    if (log_weight > most) {
      most = log_weight;
      best = k;
    }
  }
  return best;
}

}  // namespace tunica::diagnosis
