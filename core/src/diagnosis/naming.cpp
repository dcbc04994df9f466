// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/causes.hpp"
#include "diagnosis/credible.hpp"
#include "diagnosis/groups.hpp"
#include "diagnosis/rest.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double most_of_it = 0.8;

class Naming {
 public:
  Naming(Diagnosis& diagnosis, const Detection& detection, const Eigen::MatrixXf& draws, const Shapes& shapes,
         const plugins::Catalogue& catalogue)
      : d_(diagnosis), detection_(detection), draws_(draws), shapes_(shapes), catalogue_(catalogue) {}

  void run() {
    singles_ = fit_singles(d_, catalogue_);
    if (singles_.empty()) return unexplained("no mechanism of the catalogue leaves a trace in these data");
    if (!singles_.front().best) return unexplained("no mechanism could be fitted at finite amplitude");
    rank();
    const double p_one = p_of_rest(*singles_.front().best);
    // Where one may be enough, two must be worth their price.
    const double floor =
        p_one > second_alpha ? singles_.front().log_weight - log_odds_of_pair(singles_.size()) : -INFINITY;
    groups_ = fit_pairs(d_, detection_, singles_, floor, catalogue_);
    if (!groups_.empty() && groups_.front().log_weight < floor) groups_.clear();
    if (groups_.empty()) {
      one(p_one);
      return p_one > second_alpha ? judge() : not_clean();
    }
    double p = p_of_rest(*groups_.front().refitted);
    if (p <= second_alpha) {
      if (auto triples = fit_triples(d_, detection_, groups_, catalogue_); !triples.empty()) {
        groups_ = std::move(triples);
        p = p_of_rest(*groups_.front().refitted);
      }
    }
    if (p > second_alpha) {
      several(p);
      return judge();
    }
    // Nothing explains it all. What one mechanism does to most of it is worth more than what three do to a little more.
    const double rows = static_cast<double>(d_.fit.residuals.size());
    if (d_.fit.chi2 - singles_.front().best->fit.chi2 > most_of_it * (d_.fit.chi2 - rows))
      one(p_one);
    else
      several(p);
    not_clean();
  }

 private:
  [[nodiscard]] const std::string& id_of(std::size_t direction) const {
    return d_.candidates[d_.directions[direction].candidate].id;
  }

  [[nodiscard]] double p_of_rest(const Refitted& refitted) const {
    return diagnosis::p_of_rest(d_, refitted, shapes_, draws_);
  }

  void rank() {
    std::vector<double> logs;
    for (const Single& single : singles_) logs.push_back(single.log_weight);
    const double all = log_sum(logs);
    for (const Single& single : singles_) {
      const Direction& direction = d_.directions[single.direction];
      Ranked ranked{id_of(single.direction),
                    d_.candidates[direction.candidate].hypotheses[direction.hypothesis].addition.target,
                    std::exp(single.log_weight - all), score(direction, -d_.fit.residuals).T, std::nullopt};
      if (single.best) ranked.gain = d_.fit.chi2 - single.best->fit.chi2;
      d_.ranking.push_back(std::move(ranked));
    }
  }

  /// One mechanism, and those that explain the misfit as well.
  void one(double p) {
    d_.p_after = p, d_.named = 1;
    double mass = 0;
    std::vector<Explanation> explanations;
    for (std::size_t place = 0; place < singles_.size(); ++place) {
      const Single& single = singles_[place];
      if (!single.best) continue;
      const std::string& id = d_.candidates[single.candidate].id;
      if (mass >= set_mass) {
        set_best_wrong(id, single.best->fit.chi2);
        break;
      }
      Cause cause = cause_of(d_, *single.best, 0, d_.directions[single.direction], catalogue_);
      mass += cause.probability = d_.ranking[place].probability;
      cause.p_value = d_.detection.by_candidate[single.candidate];
      d_.ambiguity_set.push_back(cause.id), d_.rivals.push_back(*single.best);
      d_.causes.push_back(std::move(cause));
      explanations.push_back({single.candidate});
    }
    classify(explanations);
    d_.extension = singles_.front().best;
  }

  /// The best group, and those that explain the misfit as well.
  void several(double p) {
    const Group& best = groups_.front();
    d_.p_after = p, d_.named = best.additions.size();
    std::vector<double> logs;
    for (const Group& group : groups_) logs.push_back(group.log_weight);
    const double all = log_sum(logs);
    for (std::size_t k = 0; k < best.additions.size(); ++k) {
      Cause cause = cause_of(d_, *best.refitted, k, d_.directions[best.directions[k]], catalogue_);
      std::vector<double> with;
      for (std::size_t g = 0; g < groups_.size(); ++g)
        if (std::any_of(groups_[g].additions.begin(), groups_[g].additions.end(),
                        [&](const Addition& addition) { return addition.id == cause.id; }))
          with.push_back(logs[g]);
      cause.probability = std::min(1.0, std::exp(log_sum(with) - all));
      cause.p_value = d_.detection.by_candidate[d_.directions[best.directions[k]].candidate];
      d_.ambiguity_set.push_back(cause.id);
      d_.causes.push_back(std::move(cause));
    }
    d_.extension = best.refitted, corrected_ = correction_in(best);
    d_.rivals.push_back(*best.refitted);
    std::vector<Explanation> explanations{candidates_of(best)};
    for (const Rival& rival : rivals_of(best)) {
      if (!rival.in_set) {
        if (rival.group && !d_.gain) set_best_wrong(words(*rival.group), rival.group->refitted->fit.chi2);
        continue;
      }
      const Refitted& refitted = rival.group ? *rival.group->refitted : *rival.single->best;
      explanations.push_back(rival.group ? candidates_of(*rival.group) : Explanation{rival.single->candidate});
      bool grows = false;
      for (const Addition& addition : refitted.additions) grows = add_to_set(addition.id) || grows;
      if (!grows) continue;
      if (refitted.additions.size() == 2)
        d_.alternatives.emplace_back(refitted.additions[0].id, refitted.additions[1].id);
      d_.rivals.push_back(refitted);
    }
    classify(explanations);
  }

  /// The member of a group that by itself takes the least of what the group takes, where that is hardly anything: two
  /// causes each show in the data, and what shows only beside another makes up for its shape. Else empty.
  [[nodiscard]] std::string correction_in(const Group& group) const {
    constexpr double hardly = 0.15;
    double least = hardly * (d_.fit.chi2 - group.refitted->fit.chi2);
    std::string found;
    for (const std::size_t direction : group.directions)
      for (const Single& single : singles_) {
        if (single.candidate != d_.directions[direction].candidate) continue;
        const double alone = single.best ? d_.fit.chi2 - single.best->fit.chi2
                                         : score(d_.directions[single.direction], -d_.fit.residuals).T;
        if (alone < least) least = alone, found = d_.candidates[single.candidate].id;
      }
    return found;
  }

  /// What explains the misfit beside the best group, likeliest first: other groups as large, and single mechanisms,
  /// which are likelier before the data.
  struct Rival {
    const Group* group;    ///< or
    const Single* single;  ///< the other is null
    double log_weight;
    bool in_set = true;
  };
  [[nodiscard]] std::vector<Rival> rivals_of(const Group& best) const {
    const double odds = static_cast<double>(best.additions.size() - 1) * log_odds_of_pair(singles_.size());
    std::vector<Rival> rivals;
    std::vector<double> logs;
    for (const Group& group : groups_)
      if (group.additions.size() == best.additions.size())
        rivals.push_back({&group, nullptr, group.log_weight + odds}), logs.push_back(rivals.back().log_weight);
    for (const Single& single : singles_)
      if (single.best) rivals.push_back({nullptr, &single, single.log_weight}), logs.push_back(single.log_weight);
    std::stable_sort(rivals.begin(), rivals.end(),
                     [](const Rival& a, const Rival& b) { return a.log_weight > b.log_weight; });
    const double all = log_sum(logs);
    double mass = 0;
    for (Rival& rival : rivals) {
      rival.in_set = mass < set_mass;
      mass += std::exp(rival.log_weight - all);
    }
    std::erase_if(rivals, [&](const Rival& rival) { return rival.group && same_members(*rival.group, best); });
    return rivals;
  }

  /// How many explanations there are, look-alikes counted once.
  void classify(const std::vector<Explanation>& explanations) {
    const std::vector<std::size_t> classes = classes_of(d_, explanations);
    for (std::size_t k = 0; k < explanations.size(); ++k) {
      explanations_ = std::max(explanations_, classes[k] + 1);
      if (d_.named > 1) continue;
      d_.look_alikes.resize(explanations_);
      d_.look_alikes[classes[k]].push_back(d_.candidates[explanations[k].front()].id);
    }
  }

  [[nodiscard]] Explanation candidates_of(const Group& group) const {
    Explanation candidates;
    for (const std::size_t direction : group.directions) candidates.push_back(d_.directions[direction].candidate);
    return candidates;
  }
  static std::multiset<std::string> members(const Group& group) {
    std::multiset<std::string> ids;
    for (const Addition& addition : group.additions) ids.insert(addition.id);
    return ids;
  }
  static bool same_members(const Group& a, const Group& b) { return members(a) == members(b); }
  static std::string words(const Group& group) { return fmt::format("{}", fmt::join(members(group), " + ")); }

  bool add_to_set(const std::string& id) {
    if (std::find(d_.ambiguity_set.begin(), d_.ambiguity_set.end(), id) != d_.ambiguity_set.end()) return false;
    d_.ambiguity_set.push_back(id);
    return true;
  }

  void set_best_wrong(const std::string& id, double chi2) {
    d_.gain.emplace();
    d_.gain->best_wrong = id, d_.gain->best_wrong_after = chi2;
  }

  /// The table of verdicts, for an explanation after which the residuals are clean.
  void judge() {
    d_.verdict = d_.ambiguity_set.size() == d_.named  ? Verdict::named
                 : explanations_ <= most_explanations ? Verdict::indistinguishable
                                                      : Verdict::unknown;
    if (d_.verdict == Verdict::unknown)
      d_.reasons.push_back(
          fmt::format("{} explanations that do not look alike are about as likely as each other", explanations_));
    if (d_.verdict != Verdict::unknown && !corrected_.empty()) {
      d_.verdict = Verdict::indistinguishable, d_.unlisted = true;
      d_.reasons.push_back(
          fmt::format("{} explains next to nothing without the others, and may only correct their shape", corrected_));
    }
    if (d_.verdict != Verdict::named) return;
    const auto suspect = [this](std::string why) {
      d_.verdict = Verdict::suspect_data;
      d_.reasons.push_back(std::move(why));
    };
    const Cause& first = d_.causes.front();
    if (d_.named == 1 && catalogue_.mechanisms().at(first.id).factory.stage == Stage::data)
      return suspect(fmt::format("the misfit sits {}, and nowhere else", first.target.words()));
    for (std::size_t k = 0; k < d_.named; ++k) {
      const Cause& cause = d_.causes[k];
      if (cause.amplitude.plausible && !cause.amplitude.at_bound) continue;
      const std::string unit = cause.amplitude.unit == "1" ? "" : " " + cause.amplitude.unit;
      return suspect(fmt::format("{} would have to be {:.3g}{}, which is {}", cause.id, cause.amplitude.value, unit,
                                 cause.amplitude.at_bound ? "at its bound" : "beyond what is plausible"));
    }
    if (d_.named > 1) return;
    if (const std::string curve = carrier(d_, d_.directions[singles_.front().direction], -d_.fit.residuals);
        !curve.empty())
      suspect("the effect should show in several curves and is carried by one: " + curve);
  }

  /// Unknown, with the share that the causes take, and how much larger than it is said to be the noise would have to be
  /// for the rest to be clean: where the alarm stands at that noise too, the causes may be all there is.
  void not_clean() {
    std::vector<std::string> ids;
    for (std::size_t k = 0; k < d_.named; ++k) ids.push_back(d_.causes[k].id);
    const double rows = static_cast<double>(d_.fit.residuals.size());
    const double share = (d_.fit.chi2 - d_.extension->fit.chi2) / std::max(d_.fit.chi2 - rows, 1.0);
    unexplained(fmt::format("{} {} {:.0f} % of the misfit; what is left is no noise (p {})", fmt::join(ids, " and "),
                            ids.size() == 1 ? "takes" : "take", 100 * std::min(share, 1.0),
                            d_.p_after < 1e-4 ? "< 0.0001" : fmt::format("= {:.2g}", d_.p_after)));
    const Rest rest(d_, *d_.extension, shapes_, draws_);
    for (double factor = 1.1; factor < 20; factor *= 1.1) {
      if (rest.detection->judge(-d_.extension->fit.residuals / factor).p <= look_again) continue;
      const double alarm = detection_.judge(-d_.fit.residuals / factor).p;
      d_.noise_factor = factor;
      d_.reasons.push_back(fmt::format("with noise {:.1f} times as large it would be, and the base model {}", factor,
                                       alarm <= d_.settings.alpha ? "would still be wrong" : "would be right too"));
      return;
    }
  }

  void unexplained(std::string why) {
    d_.verdict = Verdict::unknown;
    d_.reasons.push_back(std::move(why));
  }

  Diagnosis& d_;
  const Detection& detection_;
  const Eigen::MatrixXf& draws_;
  const Shapes& shapes_;
  const plugins::Catalogue& catalogue_;
  std::vector<Single> singles_;
  std::vector<Group> groups_;
  std::string corrected_;         ///< what in the best group may be no cause of its own
  std::size_t explanations_ = 0;  ///< in the ambiguity set, look-alikes counted once
};

}  // namespace

void name_causes(Diagnosis& diagnosis, const Detection& detection, const Eigen::MatrixXf& draws, const Shapes& shapes,
                 const plugins::Catalogue& catalogue) {
  Naming(diagnosis, detection, draws, shapes, catalogue).run();
}

}  // namespace tunica::diagnosis
