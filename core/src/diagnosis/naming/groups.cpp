// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/groups.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include "diagnosis/naming/group_fits.hpp"

namespace tunica::diagnosis {
namespace {

using Side = MechanismFactory::Side;

constexpr std::size_t quick_pairs = 8, full_pairs = 24;  ///< at finite amplitude
constexpr std::size_t pool_of_each = 2;                  ///< hypotheses of a candidate that enter pairs
constexpr std::size_t seeds = 3;                         ///< of the best, and of what is left after each
constexpr std::size_t triples_tried = 6;
constexpr double short_of = 3;             ///< of ln w: what a score may underrate a refit by
constexpr double one_and_the_same = 0.02;  ///< 1 − c² below which two are one

class GroupSearch {
 public:
  GroupSearch(const Inquiry& inquiry, const Analysis& analysis, std::span<const Single> singles)
      : inquiry_(inquiry),
        analysis_(analysis),
        fit_(analysis.evidence.fit),
        hypotheses_(analysis.hypotheses),
        directions_(analysis.hypotheses.directions),
        singles_(singles),
        fits_(inquiry, analysis, singles) {}

  std::vector<Group> pairs(double floor) {
    const std::vector<std::size_t> pool = pool_of(singles_.front());
    std::vector<Group> groups;
    for (std::size_t i = 0; i < pool.size(); ++i)
      for (std::size_t j = i + 1; j < pool.size(); ++j)
        if (auto pair = linear_pair(pool[i], pool[j])) groups.push_back(std::move(*pair));
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Group& a, const Group& b) { return a.linear_gain > b.linear_gain; });
    // Of two mechanisms the two best places.
    std::map<std::multiset<std::size_t>, int> seen;
    std::erase_if(groups, [&](const Group& group) { return ++seen[candidates_of(group)] > 2; });
    groups.resize(std::min(groups.size(), inquiry_.request.quick ? quick_pairs : full_pairs));
    add_beside_singles(groups);
    std::erase_if(groups, [&](const Group& group) { return group.linear_gain / 2 < floor - short_of; });
    return fits_.refitted(std::move(groups), 0.55, 0.63);
  }

  /// It begins from several pairs; then each member of the best triple competes with possible replacements.
  std::vector<Group> triples(std::span<const Group> pairs) {
    std::vector<Group> groups;
    std::set<std::multiset<std::size_t>> seen;
    for (std::size_t g = 0; g < std::min(pairs.size(), seeds); ++g)
      extend(pairs[g], *pairs[g].refit, g == 0 ? triples_tried : seeds, groups, seen);
    groups = fits_.refitted(std::move(groups), 0.63, 0.67);
    if (groups.empty()) return groups;
    std::vector<Group> others;
    for (std::size_t out = 0; out < groups.front().additions.size(); ++out) {
      const Group rest = without_member(groups.front(), out);
      if (const auto refit = fit_with(inquiry_, analysis_, rest.additions, rest.amplitudes))
        extend(rest, *refit, seeds, others, seen);
    }
    for (Group& group : fits_.refitted(std::move(others), 0.67, 0.7)) groups.push_back(std::move(group));
    sort_by_weight(groups);
    return groups;
  }

 private:
  /// T, direction and amplitude of what explains most of the residuals of a refit, on admissible sides; best first.
  [[nodiscard]] std::vector<std::tuple<double, std::size_t, double>> what_is_left(const Refit& refit) const {
    const Projection projection(interior(refit.fit));
    std::vector<std::tuple<double, std::size_t, double>> ranking;
    for (std::size_t k = 0; k < directions_.size(); ++k) {
      const Direction& direction = directions_[k];
      const Eigen::VectorXd& whole = hypotheses_.hypothesis(k).signature;
      const Eigen::VectorXd s = projection.off(whole);
      if (!(s.norm() > invisible * whole.norm())) continue;
      const double t = -s.dot(refit.fit.residuals) / s.norm();
      if (direction.side == Side::both || t > 0) ranking.emplace_back(t * t, k, direction.sign * t / s.norm());
    }
    std::stable_sort(ranking.begin(), ranking.end(),
                     [](const auto& a, const auto& b) { return std::get<0>(a) > std::get<0>(b); });
    return ranking;
  }

  /// The best hypotheses of every candidate, alone and beside the best single one.
  [[nodiscard]] std::vector<std::size_t> pool_of(const Single& best_single) const {
    std::vector<std::pair<double, std::size_t>> alone;
    for (std::size_t k = 0; k < directions_.size(); ++k)
      alone.emplace_back(-score(directions_[k], -fit_.residuals).T, k);
    std::stable_sort(alone.begin(), alone.end());
    std::set<std::size_t> pool;
    std::map<std::size_t, std::size_t> taken;
    const auto take = [&](std::size_t k) {
      if (taken[directions_[k].candidate]++ < pool_of_each) pool.insert(k);
    };
    for (const auto& [minus_T, k] : alone) take(k);
    taken.clear();
    for (const auto& [T, k, amplitude] : what_is_left(*best_single.best)) take(k);
    return {pool.begin(), pool.end()};
  }

  /// Pairs of a good single mechanism, as it is at finite amplitude, with what explains most of what it leaves: the
  /// linearisation at the base fit does not see them where the effects are large.
  void add_beside_singles(std::vector<Group>& groups) const {
    std::set<std::multiset<std::size_t>> seen;
    for (const Group& group : groups) seen.insert(candidates_of(group));
    std::size_t used = 0;
    for (const Single& single : singles_) {
      if (!single.best || used++ >= seeds) break;
      const std::size_t k = single.direction;
      const double gain = fit_.chi2 - single.best->fit.chi2 + 2 * log_prior(directions_[k]);
      Group alone{{k},    {hypotheses_.hypothesis(k).addition}, {amplitude_of(*single.best)}, gain, 0, std::nullopt, {},
                  nullptr};
      extend(alone, *single.best, seeds, groups, seen);
    }
  }

  /// The group with each of the `count` candidates that explain most of what its refit leaves, unless seen already.
  void extend(const Group& group, const Refit& refit, std::size_t count, std::vector<Group>& onto,
              std::set<std::multiset<std::size_t>>& seen) const {
    std::set<std::size_t> tried;
    for (const std::size_t member : group.directions)
      if (!stands_beside_itself(group, member)) tried.insert(directions_[member].candidate);
    const std::size_t own = tried.size();
    const auto from = std::make_shared<const Refit>(refit);
    for (const auto& [T, k, amplitude] : what_is_left(refit)) {
      if (tried.size() >= own + count) return;
      if (!tried.insert(directions_[k].candidate).second) continue;
      Group more = group;
      more.refit.reset();
      more.losses.clear();
      more.begun_from = from;
      more.linear_gain += T + 2 * log_prior(directions_[k]);
      more.directions.push_back(k);
      more.additions.push_back(hypotheses_.hypothesis(k).addition);
      more.amplitudes.push_back(amplitude);
      if (seen.insert(candidates_of(more)).second) onto.push_back(std::move(more));
    }
  }

  /// Whether another of the same mechanism may stand beside this member, which is the only one so far.
  [[nodiscard]] bool stands_beside_itself(const Group& group, std::size_t member) const {
    const std::size_t candidate = directions_[member].candidate;
    const auto same = std::count_if(group.directions.begin(), group.directions.end(),
                                    [&](std::size_t k) { return directions_[k].candidate == candidate; });
    return same == 1 && hypotheses_.candidates[candidate].mechanism->several;
  }

  [[nodiscard]] std::multiset<std::size_t> candidates_of(const Group& group) const {
    std::multiset<std::size_t> candidates;
    for (const std::size_t k : group.directions) candidates.insert(directions_[k].candidate);
    return candidates;
  }
  /// Of the first addition, as fit_with() takes it: from its null, squared where the mechanism is even.
  [[nodiscard]] double amplitude_of(const Refit& refit) const {
    const Extension::Part& part = refit.extension->parts().front();
    const double amplitude = refit.fit.free[part.amplitude.front()] - part.null;
    const Side side = inquiry_.mechanism(refit.additions.front().id).side;
    return side == Side::even ? amplitude * amplitude : amplitude;
  }
  /// The largest gain of two amplitudes on their admissible sides; none where one of them is better left out.
  [[nodiscard]] std::optional<Group> linear_pair(std::size_t i, std::size_t j) const {
    const Direction &a = directions_[i], &b = directions_[j];
    if (a.candidate == b.candidate) return std::nullopt;
    const double c = a.unit.dot(b.unit), ta = -a.unit.dot(fit_.residuals), tb = -b.unit.dot(fit_.residuals);
    if (1 - c * c < one_and_the_same) return std::nullopt;
    const double xa = (ta - c * tb) / (1 - c * c), xb = (tb - c * ta) / (1 - c * c);
    if ((a.side != Side::both && xa <= 0) || (b.side != Side::both && xb <= 0)) return std::nullopt;
    return Group{{i, j},
                 {hypotheses_.hypothesis(i).addition, hypotheses_.hypothesis(j).addition},
                 {a.sign * xa / a.length, b.sign * xb / b.length},
                 ta * xa + tb * xb + 2 * (log_prior(directions_[i]) + log_prior(directions_[j])),
                 0,
                 std::nullopt,
                 {},
                 nullptr};
  }

  const Inquiry& inquiry_;
  const Analysis& analysis_;
  const Fit& fit_;
  const Hypotheses& hypotheses_;
  const std::vector<Direction>& directions_;
  std::span<const Single> singles_;
  const GroupFits fits_;
};

}  // namespace

double log_odds_of_pair(std::size_t candidates) {
  return std::log(0.1) - std::log(std::max(1.0, (static_cast<double>(candidates) - 1) / 2));
}

std::vector<Group> fit_pairs(const Inquiry& inquiry, const Analysis& analysis, const std::vector<Single>& singles,
                             double floor) {
  return GroupSearch(inquiry, analysis, singles).pairs(floor);
}

std::vector<Group> fit_triples(const Inquiry& inquiry, const Analysis& analysis, std::span<const Group> pairs) {
  return GroupSearch(inquiry, analysis, {}).triples(pairs);
}

}  // namespace tunica::diagnosis
