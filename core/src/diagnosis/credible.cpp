// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/credible.hpp"

#include <set>

#include "diagnosis/detectable.hpp"

namespace tunica::diagnosis {
namespace {

/// Whether each member of `a` from `first` on finds a partner of its own in `b`.
bool alike(const Eigen::MatrixXd& likeness, const Explanation& a, const Explanation& b, std::size_t first = 0,
           const std::set<std::size_t>& taken = {}) {
  if (a.size() != b.size()) return false;
  if (first == a.size()) return true;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(a[first]), j = static_cast<Eigen::Index>(b[k]);
    if (taken.contains(k) || !(i == j || likeness(i, j) > look_alike)) continue;
    std::set<std::size_t> now = taken;
    now.insert(k);
    if (alike(likeness, a, b, first + 1, now)) return true;
  }
  return false;
}

}  // namespace

std::vector<std::size_t> classes_of(const Diagnosis& diagnosis, const std::vector<Explanation>& explanations) {
  const Eigen::MatrixXd alikes = likeness(diagnosis.directions, diagnosis.candidates.size());
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> classes(explanations.size(), none);
  std::size_t count = 0;
  for (std::size_t first = 0; first < explanations.size(); ++first) {
    if (classes[first] != none) continue;
    std::vector<std::size_t> reached{first};
    classes[first] = count;
    for (std::size_t at = 0; at < reached.size(); ++at)
      for (std::size_t other = 0; other < explanations.size(); ++other)
        if (classes[other] == none && alike(alikes, explanations[reached[at]], explanations[other]))
          classes[other] = count, reached.push_back(other);
    ++count;
  }
  return classes;
}

}  // namespace tunica::diagnosis
