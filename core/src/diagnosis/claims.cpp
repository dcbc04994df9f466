// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/claims.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/causes.hpp"
#include "diagnosis/credible.hpp"

namespace tunica::diagnosis {
namespace {

/// Of what a group takes, below which a member that is alone takes next to nothing.
constexpr double next_to_nothing = 0.15;

std::vector<std::string> ids_of(const std::vector<Addition>& additions) {
  std::vector<std::string> ids;
  for (const Addition& addition : additions) ids.push_back(addition.id);
  return ids;
}

void add_to_set(Diagnosis& d, const std::string& id) {
  if (std::find(d.ambiguity_set.begin(), d.ambiguity_set.end(), id) == d.ambiguity_set.end())
    d.ambiguity_set.push_back(id);
}

/// Of what is outside the set, that which leaves least.
void offer_as_wrong(Diagnosis& d, const Refitted& refitted) {
  if (d.gain && !(refitted.fit.chi2 < d.gain->best_wrong_after)) return;
  d.gain.emplace();
  d.gain->best_wrong = fmt::format("{}", fmt::join(ids_of(refitted.additions), " + "));
  d.gain->best_wrong_after = refitted.fit.chi2;
}

/// How many explanations there are, look-alikes counted once.
std::size_t count_of(const std::vector<std::size_t>& classes) {
  return classes.empty() ? 0 : *std::max_element(classes.begin(), classes.end()) + 1;
}

std::string correction_in(const Diagnosis& d, const Group& group, const std::vector<Single>& singles) {
  double least = next_to_nothing * (d.fit.chi2 - group.refitted->fit.chi2);
  std::string found;
  for (const std::size_t member : group.directions)
    for (const Single& single : singles) {
      const std::size_t candidate = d.directions[member].candidate;
      if (single.candidate != candidate) continue;
      const double alone =
          single.best ? d.fit.chi2 - single.best->fit.chi2 : score(d.directions[single.direction], -d.fit.residuals).T;
      if (alone < least) least = alone, found = d.candidates[candidate].id;
    }
  return found;
}

/// A group as large as the best, or a single mechanism.
struct Rival {
  const Group* group;
  const Single* single;
  double log_weight;
  double probability = 0;
  bool in_set = true;

  [[nodiscard]] const Refitted& refitted() const { return group ? *group->refitted : *single->best; }
};

/// Likeliest first; the best group is the first of them.
std::vector<Rival> rivals_of(const std::vector<Group>& groups, const std::vector<Single>& singles) {
  const Group& best = groups.front();
  const double odds = static_cast<double>(best.additions.size() - 1) * log_odds_of_pair(singles.size());
  std::vector<Rival> rivals;
  for (const Group& group : groups)
    if (group.additions.size() == best.additions.size()) rivals.push_back({&group, nullptr, group.log_weight + odds});
  for (const Single& single : singles)
    if (single.best) rivals.push_back({nullptr, &single, single.log_weight});
  std::stable_sort(rivals.begin() + 1, rivals.end(),
                   [](const Rival& a, const Rival& b) { return a.log_weight > b.log_weight; });
  std::vector<double> logs;
  for (const Rival& rival : rivals) logs.push_back(rival.log_weight);
  const double all = log_sum(logs);
  double mass = 0;
  for (Rival& rival : rivals) {
    rival.in_set = mass < set_mass;
    mass += rival.probability = std::exp(rival.log_weight - all);
  }
  return rivals;
}

/// The members of the best group as causes; of each, the probability of all explanations that it is in.
void add_causes(Diagnosis& d, const Detection& detection, const Group& best, const std::vector<Rival>& rivals,
                const plugins::Catalogue& catalogue) {
  for (std::size_t k = 0; k < best.additions.size(); ++k) {
    const Direction& direction = d.directions[best.directions[k]];
    d.best_direction[direction.candidate] = best.directions[k];
    Cause cause = cause_of(d, *best.refitted, k, direction, catalogue);
    for (const Rival& rival : rivals) {
      const std::vector<std::string> ids = ids_of(rival.refitted().additions);
      if (std::find(ids.begin(), ids.end(), cause.id) != ids.end()) cause.probability += rival.probability;
    }
    cause.probability = std::min(cause.probability, 1.0);
    cause.p_value = detection.candidate_p(direction.candidate, best.losses[k]);
    add_to_set(d, cause.id);
    d.causes.push_back(std::move(cause));
  }
}

}  // namespace

Claim claim_one(Diagnosis& d, const Detection& detection, const std::vector<Single>& singles,
                const plugins::Catalogue& catalogue) {
  d.named = 1;
  double mass = 0;
  std::vector<Explanation> explanations;
  for (std::size_t place = 0; place < singles.size(); ++place) {
    const Single& single = singles[place];
    if (!single.best) continue;
    if (mass >= set_mass) {
      offer_as_wrong(d, *single.best);
      continue;
    }
    Cause cause = cause_of(d, *single.best, 0, d.directions[single.direction], catalogue);
    mass += cause.probability = d.ranking[place].probability;
    cause.p_value = detection.candidate_p(single.candidate, cause.gain);
    add_to_set(d, cause.id), d.rivals.push_back(*single.best);
    d.causes.push_back(std::move(cause));
    explanations.push_back({single.direction});
  }
  d.extension = singles.front().best;
  const std::vector<std::size_t> classes = classes_of(d.directions, explanations);
  d.look_alikes.resize(count_of(classes));
  for (std::size_t k = 0; k < classes.size(); ++k) d.look_alikes[classes[k]].push_back(d.causes[k].id);
  return {d.look_alikes.size(), d.causes.size() == 1, {}};
}

Claim claim_several(Diagnosis& d, const Detection& detection, const std::vector<Group>& groups,
                    const std::vector<Single>& singles, const plugins::Catalogue& catalogue) {
  const Group& best = groups.front();
  const std::vector<Rival> rivals = rivals_of(groups, singles);
  d.named = best.additions.size();
  add_causes(d, detection, best, rivals, catalogue);
  d.extension = best.refitted;
  std::vector<Explanation> explanations;
  std::set<std::multiset<std::string>> seen;
  const std::vector<std::string> causes = ids_of(best.additions);
  for (const Rival& rival : rivals) {
    const Refitted& refitted = rival.refitted();
    const std::vector<std::string> ids = ids_of(refitted.additions);
    // In other places the same mechanisms are no other explanation.
    if (!seen.insert({ids.begin(), ids.end()}).second) continue;
    if (!rival.in_set) {
      // One of the causes by itself is not wrong, it is not all.
      if (rival.group || std::find(causes.begin(), causes.end(), ids.front()) == causes.end())
        offer_as_wrong(d, refitted);
      continue;
    }
    for (const std::string& id : ids) add_to_set(d, id);
    if (rival.group != &best) d.alternatives.push_back(ids);
    d.rivals.push_back(refitted);
    explanations.push_back(rival.group ? rival.group->directions : Explanation{rival.single->direction});
  }
  return {count_of(classes_of(d.directions, explanations)), d.alternatives.empty(), correction_in(d, best, singles)};
}

}  // namespace tunica::diagnosis
