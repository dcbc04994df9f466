// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/left_out.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "cohort_diagnosis/common_amplitude.hpp"

namespace tunica::cohort_diagnosis {
namespace {

constexpr std::size_t most_parts = 20;  ///< above so many specimens are left out part by part

/// 2 ℓ(y), y being a distance from the null; 0 on a side that the specimen does not have.
double gain_at(const Profile& profile, double y) {
  const std::optional<Half>& half = y >= 0 ? profile.up : profile.down;
  if (!half) return 0;
  const double moved = half->length * std::abs(y);
  return 2 * half->t * moved - moved * moved;
}

}  // namespace

std::vector<LeftOut> left_out(const Specimens& specimens, const Hypothesis& cause, const std::vector<bool>& affected) {
  std::vector<std::size_t> members;
  for (std::size_t s = 0; s < specimens.size(); ++s)
    if (affected[s] && cause.sees[s]) members.push_back(s);
  if (members.size() < 2) return {};
  const std::size_t parts = std::min(members.size(), most_parts);
  std::vector<double> foretold(parts);
  tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
    std::vector<bool> others(specimens.size(), false);
    for (std::size_t k = 0; k < members.size(); ++k) others[members[k]] = k % parts != part;
    foretold[part] = common_amplitude(cause, others).mean - cause.like().null;
  });
  std::vector<LeftOut> found;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const SpecimenEvidence& specimen = *specimens[members[k]];
    const Profile& seen = cause.seen[members[k]];
    found.push_back({specimen.id, specimen.rows, specimen.squares, specimen.squares - seen.gain(),
                     specimen.squares - gain_at(seen, foretold[k % parts])});
  }
  return found;
}

}  // namespace tunica::cohort_diagnosis
