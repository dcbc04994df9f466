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

std::multiset<std::string> members(const Group& group) {
  std::multiset<std::string> ids;
  for (const Addition& addition : group.additions) ids.insert(addition.id);
  return ids;
}
std::string words(const Group& group) { return fmt::format("{}", fmt::join(members(group), " + ")); }

Explanation candidates_of(const Diagnosis& d, const Group& group) {
  Explanation candidates;
  for (const std::size_t direction : group.directions) candidates.push_back(d.directions[direction].candidate);
  return candidates;
}

void set_best_wrong(Diagnosis& d, const std::string& id, double chi2) {
  if (d.gain) return;
  d.gain.emplace();
  d.gain->best_wrong = id, d.gain->best_wrong_after = chi2;
}

bool add_to_set(Diagnosis& d, const std::string& id) {
  if (std::find(d.ambiguity_set.begin(), d.ambiguity_set.end(), id) != d.ambiguity_set.end()) return false;
  d.ambiguity_set.push_back(id);
  return true;
}

/// How many explanations there are, look-alikes counted once.
std::size_t classify(Diagnosis& d, const std::vector<Explanation>& explanations) {
  const std::vector<std::size_t> classes = classes_of(d, explanations);
  std::size_t count = 0;
  for (std::size_t k = 0; k < explanations.size(); ++k) {
    count = std::max(count, classes[k] + 1);
    if (d.named > 1) continue;
    d.look_alikes.resize(count);
    d.look_alikes[classes[k]].push_back(d.candidates[explanations[k].front()].id);
  }
  return count;
}

std::string correction_in(const Diagnosis& d, const Group& group, const std::vector<Single>& singles) {
  double least = next_to_nothing * (d.fit.chi2 - group.refitted->fit.chi2);
  std::string found;
  for (const std::size_t candidate : candidates_of(d, group))
    for (const Single& single : singles) {
      if (single.candidate != candidate) continue;
      const double alone =
          single.best ? d.fit.chi2 - single.best->fit.chi2 : score(d.directions[single.direction], -d.fit.residuals).T;
      if (alone < least) least = alone, found = d.candidates[candidate].id;
    }
  return found;
}

/// What may stand for the best group: another group or a single mechanism, of which the other is null.
struct Rival {
  const Group* group;
  const Single* single;
  double log_weight;
  bool in_set = true;
};

/// Likeliest first; the best group is in none of them.
std::vector<Rival> rivals_of(const std::vector<Group>& groups, const std::vector<Single>& singles) {
  const Group& best = groups.front();
  const double odds = static_cast<double>(best.additions.size() - 1) * log_odds_of_pair(singles.size());
  std::vector<Rival> rivals;
  for (const Group& group : groups)
    if (group.additions.size() == best.additions.size()) rivals.push_back({&group, nullptr, group.log_weight + odds});
  for (const Single& single : singles)
    if (single.best) rivals.push_back({nullptr, &single, single.log_weight});
  std::stable_sort(rivals.begin(), rivals.end(),
                   [](const Rival& a, const Rival& b) { return a.log_weight > b.log_weight; });
  std::vector<double> logs;
  for (const Rival& rival : rivals) logs.push_back(rival.log_weight);
  const double all = log_sum(logs);
  double mass = 0;
  for (Rival& rival : rivals) {
    rival.in_set = mass < set_mass;
    mass += std::exp(rival.log_weight - all);
  }
  std::erase_if(rivals, [&](const Rival& rival) { return rival.group && members(*rival.group) == members(best); });
  return rivals;
}

/// The members of the best group as causes; of each, the probability of all groups that it is in.
void add_causes(Diagnosis& d, const std::vector<Group>& groups, const plugins::Catalogue& catalogue) {
  const Group& best = groups.front();
  std::vector<double> logs;
  for (const Group& group : groups) logs.push_back(group.log_weight);
  const double all = log_sum(logs);
  for (std::size_t k = 0; k < best.additions.size(); ++k) {
    Cause cause = cause_of(d, *best.refitted, k, d.directions[best.directions[k]], catalogue);
    std::vector<double> with;
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (members(groups[g]).contains(cause.id)) with.push_back(logs[g]);
    cause.probability = std::min(1.0, std::exp(log_sum(with) - all));
    cause.p_value = d.detection.by_candidate[d.directions[best.directions[k]].candidate];
    d.ambiguity_set.push_back(cause.id);
    d.causes.push_back(std::move(cause));
  }
}

}  // namespace

Claim claim_one(Diagnosis& d, const std::vector<Single>& singles, const plugins::Catalogue& catalogue) {
  d.named = 1;
  double mass = 0;
  std::vector<Explanation> explanations;
  for (std::size_t place = 0; place < singles.size(); ++place) {
    const Single& single = singles[place];
    if (!single.best) continue;
    if (mass >= set_mass) {
      set_best_wrong(d, d.candidates[single.candidate].id, single.best->fit.chi2);
      break;
    }
    Cause cause = cause_of(d, *single.best, 0, d.directions[single.direction], catalogue);
    mass += cause.probability = d.ranking[place].probability;
    cause.p_value = d.detection.by_candidate[single.candidate];
    d.ambiguity_set.push_back(cause.id), d.rivals.push_back(*single.best);
    d.causes.push_back(std::move(cause));
    explanations.push_back({single.candidate});
  }
  d.extension = singles.front().best;
  return {classify(d, explanations), {}};
}

Claim claim_several(Diagnosis& d, const std::vector<Group>& groups, const std::vector<Single>& singles,
                    const plugins::Catalogue& catalogue) {
  const Group& best = groups.front();
  d.named = best.additions.size();
  add_causes(d, groups, catalogue);
  d.extension = best.refitted;
  d.rivals.push_back(*best.refitted);
  std::vector<Explanation> explanations{candidates_of(d, best)};
  for (const Rival& rival : rivals_of(groups, singles)) {
    if (!rival.in_set) {
      if (rival.group) set_best_wrong(d, words(*rival.group), rival.group->refitted->fit.chi2);
      continue;
    }
    const Refitted& refitted = rival.group ? *rival.group->refitted : *rival.single->best;
    explanations.push_back(rival.group ? candidates_of(d, *rival.group) : Explanation{rival.single->candidate});
    bool grows = false;
    for (const Addition& addition : refitted.additions) grows = add_to_set(d, addition.id) || grows;
    if (!grows) continue;
    if (refitted.additions.size() == 2) d.alternatives.emplace_back(refitted.additions[0].id, refitted.additions[1].id);
    d.rivals.push_back(refitted);
  }
  return {classify(d, explanations), correction_in(d, best, singles)};
}

}  // namespace tunica::diagnosis
