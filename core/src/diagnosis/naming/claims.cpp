// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/claims.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/naming/causes.hpp"
#include "diagnosis/naming/credibility.hpp"
#include "diagnosis/naming/credible.hpp"

namespace tunica::diagnosis {
namespace {

/// The share of a group's gain below which the gain of a single member is negligible.
constexpr double small_share = 0.15;

std::vector<std::string> ids_of(const std::vector<Addition>& additions) {
  std::vector<std::string> ids;
  for (const Addition& addition : additions) ids.push_back(addition.id);
  return ids;
}

bool contains_id(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

void add_once(std::vector<std::string>& set, const std::string& id) {
  if (!contains_id(set, id)) set.push_back(id);
}

/// Of two explanations outside the set, that which leaves less.
Rejected better_rejected(const std::optional<Rejected>& known, const Refit& refit) {
  if (known && !(refit.fit.chi2 < known->after)) return *known;
  return {fmt::format("{}", fmt::join(ids_of(refit.additions), " + ")), refit.fit.chi2};
}

/// How many explanations there are, look-alikes counted once.
std::size_t count_of(const std::vector<std::size_t>& classes) {
  return classes.empty() ? 0 : *std::max_element(classes.begin(), classes.end()) + 1;
}

std::string correction_in(const Analysis& analysis, const Group& group, const std::vector<Single>& singles) {
  const Fit& fit = analysis.evidence.fit;
  const Hypotheses& hypotheses = analysis.hypotheses;
  double least = small_share * (fit.chi2 - group.refit->fit.chi2);
  std::string found;
  for (const std::size_t member : group.directions)
    for (const Single& single : singles) {
      const std::size_t candidate = hypotheses.directions[member].candidate;
      if (single.candidate != candidate) continue;
      const double alone = single.best ? fit.chi2 - single.best->fit.chi2
                                       : score(hypotheses.directions[single.direction], -fit.residuals).T;
      if (alone >= least) continue;
      least = alone;
      found = hypotheses.candidates[candidate].id;
    }
  return found;
}

/// A group as large as the best, or a single mechanism.
struct Rival {
  const Group* group;
  const Single* single;
  double log_weight;
  double probability = 0;
  bool in_set = true, credible = true;

  [[nodiscard]] const Refit& refit() const { return group ? *group->refit : *single->best; }
  [[nodiscard]] ActingTogether directions() const {
    return group ? group->directions : ActingTogether{single->direction};
  }
};

/// Groups and singles were weighed among themselves. Beside a credible group that leaves only noise, what is not
/// credible weighs a twentieth of it together.
void weigh_doubt(std::vector<Rival>& rivals) {
  const auto doubtful = std::count_if(rivals.begin(), rivals.end(), [](const Rival& one) { return !one.credible; });
  if (doubtful == 0 || !rivals.front().credible) return;
  const double most = rivals.front().log_weight - std::log(odds_against * static_cast<double>(doubtful));
  for (Rival& rival : rivals)
    if (!rival.credible) rival.log_weight = std::min(rival.log_weight, most);
}

/// Likeliest first; the best group is the first of them.
std::vector<Rival> rivals_of(const Inquiry& inquiry, const Analysis& analysis, const std::vector<Group>& groups,
                             const std::vector<Single>& singles, bool clean) {
  const Group& best = groups.front();
  const double odds = static_cast<double>(best.additions.size() - 1) * log_odds_of_pair(singles.size());
  std::vector<Rival> rivals;
  for (const Group& group : groups)
    if (group.additions.size() == best.additions.size()) rivals.push_back({&group, nullptr, group.log_weight + odds});
  for (const Single& single : singles)
    if (single.best) rivals.push_back({nullptr, &single, single.log_weight});
  for (Rival& rival : rivals) rival.credible = is_credible(inquiry, analysis, rival.refit(), rival.directions());
  if (clean) weigh_doubt(rivals);
  std::stable_sort(rivals.begin() + 1, rivals.end(),
                   [](const Rival& a, const Rival& b) { return a.log_weight > b.log_weight; });
  std::vector<double> logs;
  for (const Rival& rival : rivals) logs.push_back(rival.log_weight);
  const double all = log_sum(logs);
  double mass = 0;
  for (Rival& rival : rivals) {
    rival.in_set = mass < set_mass;
    rival.probability = std::exp(rival.log_weight - all);
    mass += rival.probability;
  }
  return rivals;
}

/// The members of the best group as causes; of each, the probability of all explanations that it is in.
std::vector<Cause> causes_of_group(const Inquiry& inquiry, const Analysis& analysis, const Group& best,
                                   const std::vector<Rival>& rivals) {
  std::vector<Cause> causes;
  for (std::size_t k = 0; k < best.additions.size(); ++k) {
    const Direction& direction = analysis.hypotheses.directions[best.directions[k]];
    Cause cause = cause_of(inquiry, analysis, *best.refit, k, direction);
    for (const Rival& rival : rivals)
      if (contains_id(ids_of(rival.refit().additions), cause.id)) cause.probability += rival.probability;
    cause.probability = std::min(cause.probability, 1.0);
    cause.p_value = analysis.alarm.detector->candidate_p(direction.candidate, best.losses[k]);
    causes.push_back(std::move(cause));
  }
  return causes;
}

}  // namespace

WeighedClaim claim_one(const Inquiry& inquiry, const Analysis& analysis, const std::vector<Single>& singles,
                       const std::vector<RankedMechanism>& ranking) {
  const std::vector<Direction>& directions = analysis.hypotheses.directions;
  Claim claim;
  claim.named = 1;
  claim.best = singles.front().best;
  double mass = 0;
  std::vector<ActingTogether> explanations;
  for (std::size_t place = 0; place < singles.size(); ++place) {
    const Single& single = singles[place];
    if (!single.best) continue;
    if (mass >= set_mass) {
      claim.best_rejected = better_rejected(claim.best_rejected, *single.best);
      continue;
    }
    Cause cause = cause_of(inquiry, analysis, *single.best, 0, directions[single.direction]);
    cause.probability = ranking[place].probability;
    mass += cause.probability;
    cause.p_value = analysis.alarm.detector->candidate_p(single.candidate, cause.gain);
    add_once(claim.ambiguity_set, cause.id);
    if (cause.amplitude.at_bound || !cause.amplitude.plausible) claim.doubted.insert({cause.id});
    claim.rivals.push_back(*single.best);
    claim.causes.push_back(std::move(cause));
    explanations.push_back({single.direction});
  }
  const std::vector<std::size_t> classes = classes_of(directions, explanations);
  claim.look_alikes.resize(count_of(classes));
  for (std::size_t k = 0; k < classes.size(); ++k) claim.look_alikes[classes[k]].push_back(claim.causes[k].id);
  const std::size_t count = claim.look_alikes.size();
  const bool alone = claim.causes.size() == 1;
  return {std::move(claim), {singles.front().direction}, count, alone, {}};
}

WeighedClaim claim_several(const Inquiry& inquiry, const Analysis& analysis, const std::vector<Group>& groups,
                           const std::vector<Single>& singles, bool clean) {
  const Group& best = groups.front();
  const std::vector<Rival> rivals = rivals_of(inquiry, analysis, groups, singles, clean);
  const std::vector<std::string> own = ids_of(best.additions);
  Claim claim;
  claim.named = best.additions.size();
  claim.causes = causes_of_group(inquiry, analysis, best, rivals);
  claim.best = best.refit;
  for (const std::string& id : own) add_once(claim.ambiguity_set, id);
  std::vector<ActingTogether> explanations;
  std::set<std::multiset<std::string>> seen;
  for (const Rival& rival : rivals) {
    const std::vector<std::string> ids = ids_of(rival.refit().additions);
    // The same mechanisms in other places are not another explanation.
    if (!seen.insert({ids.begin(), ids.end()}).second) continue;
    if (!rival.in_set) {
      // A single one of the causes is not wrong, but incomplete.
      if (rival.group || !contains_id(own, ids.front()))
        claim.best_rejected = better_rejected(claim.best_rejected, rival.refit());
      continue;
    }
    for (const std::string& id : ids) add_once(claim.ambiguity_set, id);
    if (!rival.credible) claim.doubted.insert(ids);
    if (rival.group != &best) claim.alternatives.push_back(ids);
    claim.rivals.push_back(rival.refit());
    explanations.push_back(rival.directions());
  }
  const std::size_t count = count_of(classes_of(analysis.hypotheses.directions, explanations));
  const bool alone = claim.alternatives.empty();
  return {std::move(claim), best.directions, count, alone, correction_in(analysis, best, singles)};
}

}  // namespace tunica::diagnosis
