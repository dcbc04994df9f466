// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/credible.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::diagnosis {
namespace {

bool look_alike_together(const std::vector<Direction>& directions, const ActingTogether& a, ActingTogether b) {
  if (a.size() != b.size()) return false;
  // Three at most: every order of the partners is tried.
  std::sort(b.begin(), b.end());
  do {
    bool all = true;
    for (std::size_t k = 0; k < a.size(); ++k) {
      const std::size_t own = directions[a[k]].candidate, other = directions[b[k]].candidate;
      all = all && (own == other || likeness(directions, a[k], other) > look_alike ||
                    likeness(directions, b[k], own) > look_alike);
    }
    if (all) return true;
  } while (std::next_permutation(b.begin(), b.end()));
  return false;
}

}  // namespace

double likeness(const std::vector<Direction>& directions, std::size_t direction, std::size_t candidate) {
  double largest = 0;
  for (const Direction& other : directions)
    if (other.candidate == candidate) largest = std::max(largest, std::abs(directions[direction].unit.dot(other.unit)));
  return std::min(largest, 1.0);
}

Eigen::MatrixXd likeness(const Hypotheses& hypotheses, const std::vector<std::optional<std::size_t>>& best) {
  const auto C = static_cast<Eigen::Index>(hypotheses.candidates.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Identity(C, C);
  for (Eigen::Index a = 0; a < C; ++a)
    for (Eigen::Index b = 0; b < C; ++b)
      if (const auto own = best[static_cast<std::size_t>(a)]; own && a != b)
        all(a, b) = likeness(hypotheses.directions, *own, static_cast<std::size_t>(b));
  return all;
}

std::vector<std::size_t> classes_of(const std::vector<Direction>& directions,
                                    const std::vector<ActingTogether>& explanations) {
  std::vector<std::size_t> classes, first;
  for (std::size_t k = 0; k < explanations.size(); ++k) {
    const auto own = std::find_if(first.begin(), first.end(), [&](std::size_t f) {
      return look_alike_together(directions, explanations[f], explanations[k]);
    });
    classes.push_back(static_cast<std::size_t>(own - first.begin()));
    if (own == first.end()) first.push_back(k);
  }
  return classes;
}

}  // namespace tunica::diagnosis
