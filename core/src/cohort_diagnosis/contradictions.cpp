// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/contradictions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "cohort_diagnosis/remainder.hpp"

namespace tunica::cohort_diagnosis {
namespace {

constexpr double clearly = 3;      ///< of ln: what is needed to say that a specimen differs
constexpr double no_noise = 1e-4;  ///< p-value of what is left in one specimen

/// The likeliest other mechanism of a specimen, by its gain.
const Profile* best_other(const std::vector<Hypothesis>& all, std::size_t specimen, const std::string& id) {
  const Profile* best = nullptr;
  for (const Hypothesis& one : all)
    if (one.sees[specimen] && one.id() != id && !one.like().place.row)
      if (!best || one.seen[specimen].gain() > best->gain()) best = &one.seen[specimen];
  return best;
}

std::optional<Contradiction> of_one(const Specimens& specimens, const Hypothesis& cause,
                                    const std::vector<Hypothesis>& all, const std::vector<bool>& affected,
                                    std::size_t s) {
  const std::string& id = specimens[s]->id;
  if (!cause.sees[s]) return std::nullopt;
  const Profile& own = cause.seen[s];
  const double gain = own.gain() / 2;
  if (!affected[s]) {
    if (gain < clearly) return std::nullopt;
    return Contradiction{
        id, ContradictionKind::shows_effect,
        fmt::format("it shows {} too (ln of the evidence {:.1f}), unlike the others of its group", cause.id(), gain)};
  }
  std::vector<bool> others = affected;
  others[s] = false;
  if (std::none_of(others.begin(), others.end(), [](bool one) { return one; })) return std::nullopt;
  const double expected = log_marginal(own, cause.likeliest(others));
  if (expected < -clearly && gain < clearly)
    return Contradiction{id, ContradictionKind::not_seen,
                         fmt::format("the others make {} likely here, and it does not show", cause.id())};
  if (gain - expected > 2 * clearly)
    return Contradiction{id, ContradictionKind::other_size,
                         fmt::format("its {} = {:.3g} lies apart from those of the others", own.amplitude,
                                     amplitude_at(own, own.distance()))};
  if (const Profile* rival = best_other(all, s, cause.id()); rival && rival->gain() / 2 > gain + clearly)
    return Contradiction{
        id, ContradictionKind::other_cause,
        fmt::format("{} explains it better (by {:.1f} in ln of the likelihood)", rival->id, rival->gain() / 2 - gain)};
  return std::nullopt;
}

}  // namespace

std::vector<Contradiction> contradictions_of(const Specimens& specimens, const std::vector<const Hypothesis*>& causes,
                                             const std::vector<Hypothesis>& all, const std::vector<bool>& affected) {
  std::vector<Contradiction> found;
  for (std::size_t s = 0; s < specimens.size(); ++s) {
    std::optional<Contradiction> own;
    if (causes.size() == 1) own = of_one(specimens, *causes.front(), all, affected, s);
    std::vector<const Profile*> seen;
    for (const Hypothesis* cause : causes)
      if (cause->sees[s]) seen.push_back(&cause->seen[s]);
    if (const double p = rest_of(*specimens[s], seen).p(); !own && p < no_noise)
      own = Contradiction{specimens[s]->id, ContradictionKind::rest_is_left,
                          fmt::format("what the cause leaves of it is no noise ({})", p_words(p))};
    if (own) found.push_back(std::move(*own));
  }
  return found;
}

}  // namespace tunica::cohort_diagnosis
