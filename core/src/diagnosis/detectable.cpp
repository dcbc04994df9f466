// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/detectable.hpp"

#include <cmath>
#include <limits>

namespace tunica::diagnosis {
namespace {

constexpr double power_80 = 0.8416;     ///< quantile of the normal distribution
constexpr double identified_at = 5.41;  ///< 2 · 1.645²: one of two is preferred with 95 % probability
constexpr double equal_above = 0.999;

}  // namespace

Eigen::MatrixXd likeness(const std::vector<Direction>& directions, std::size_t candidates) {
  const auto C = static_cast<Eigen::Index>(candidates), D = static_cast<Eigen::Index>(directions.size());
  Eigen::MatrixXd largest = Eigen::MatrixXd::Zero(C, C);
  if (D == 0) return largest;
  Eigen::MatrixXd units(directions.front().unit.size(), D);
  for (Eigen::Index k = 0; k < D; ++k) units.col(k) = directions[static_cast<std::size_t>(k)].unit;
  const Eigen::MatrixXd correlations = units.transpose() * units;
  for (Eigen::Index b = 0; b < D; ++b)
    for (Eigen::Index a = 0; a < D; ++a) {
      double& entry = largest(static_cast<Eigen::Index>(directions[static_cast<std::size_t>(a)].candidate),
                              static_cast<Eigen::Index>(directions[static_cast<std::size_t>(b)].candidate));
      entry = std::max(entry, std::abs(correlations(a, b)));
    }
  return largest;
}

std::vector<Detectable> detectable(const Diagnosis& d, const Detection& detection) {
  std::vector<Detectable> found;
  for (std::size_t c = 0; c < d.candidates.size(); ++c) {
    const Candidate& candidate = d.candidates[c];
    Detectable entry;
    entry.id = candidate.id, entry.unit = candidate.mechanism->parameters.front().unit;
    const Direction* best = nullptr;
    for (const Direction& direction : d.directions)
      if (direction.candidate == c && !candidate.hypotheses[direction.hypothesis].addition.target.row &&
          (!best || direction.length > best->length))
        best = &direction;
    if (!best) {
      entry.absent = candidate.absent.empty() ? "a refit of the parameters absorbs it" : candidate.absent;
      entry.detectable = entry.identifiable = std::numeric_limits<double>::infinity();
      found.push_back(std::move(entry));
      continue;
    }
    entry.target = candidate.hypotheses[best->hypothesis].addition.target, entry.retained = best->retained;
    for (const Direction& other : d.directions) {
      if (other.candidate == c) continue;
      const double c_abs = std::abs(best->unit.dot(other.unit));
      if (c_abs > entry.correlation) entry.correlation = c_abs, entry.closest = d.candidates[other.candidate].id;
    }
    const auto amplitude = [&](double Lambda) {
      const double delta = std::sqrt(Lambda) / best->length;
      return best->side == MechanismFactory::Side::even ? std::sqrt(delta) : delta;
    };
    const double T = detection.threshold(c, d.settings.alpha);
    const double Lambda = std::pow(std::sqrt(T) + power_80, 2);
    entry.detectable = amplitude(Lambda);
    entry.identifiable = entry.correlation > equal_above
                             ? std::numeric_limits<double>::infinity()
                             : amplitude(std::max(Lambda, identified_at / (1 - entry.correlation)));
    found.push_back(std::move(entry));
  }
  return found;
}

}  // namespace tunica::diagnosis
