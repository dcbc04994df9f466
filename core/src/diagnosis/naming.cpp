// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "diagnosis/causes.hpp"

namespace tunica::diagnosis {
namespace {

using Side = MechanismFactory::Side;

/// One candidate as the only explanation.
struct Single {
  std::size_t candidate = 0;
  double log_weight = -INFINITY;
  std::size_t direction = 0;  ///< the best hypothesis
  std::optional<Refitted> best;
};

/// Two or three additions together.
struct Group {
  std::vector<std::size_t> candidates;
  std::vector<Addition> additions;
  std::vector<double> amplitudes;
  double linear_gain = 0;
  std::optional<Refitted> refitted;
};

double log_side(Side side, double T) {
  return side == Side::both ? 0 : std::log(std::erfc(-std::sqrt(std::max(T, 0.0) / 2)));
}

double log_sum(const std::vector<double>& logs) {
  if (logs.empty()) return -INFINITY;
  const double largest = *std::max_element(logs.begin(), logs.end());
  double sum = 0;
  for (const double value : logs) sum += std::exp(value - largest);
  return largest + std::log(sum);
}

class Naming {
 public:
  Naming(Diagnosis& diagnosis, const Detection& detection, const Eigen::MatrixXf& draws, const Shapes& shapes,
         const plugins::Catalogue& catalogue)
      : d_(diagnosis),
        detection_(detection),
        draws_(draws),
        shapes_(shapes),
        catalogue_(catalogue),
        residuals_(-diagnosis.fit.residuals) {
    scores_.reserve(d_.directions.size());
    for (const Direction& direction : d_.directions) scores_.push_back(score(direction, residuals_));
  }

  void run() {
    singles();
    if (order_.empty()) return unexplained("no mechanism of the catalogue leaves a trace in these data");
    const Single& first = singles_[order_.front()];
    if (!first.best) return unexplained("no mechanism could be fitted at finite amplitude");
    double p = clean(*first.best);
    if (p > second_alpha) return one(p);
    pairs();
    if (!groups_.empty()) {
      const double p_pair = clean(*groups_.front().refitted);
      if (p_pair > second_alpha) return several(p_pair);
      third();
      const double p_triple = clean(*groups_.front().refitted);
      if (groups_.front().additions.size() == 3 && p_triple > second_alpha) return several(p_triple);
      p = std::max(p_pair, p_triple);
      if (groups_.front().additions.size() >= 2) {
        several(p);
        return unexplained(fmt::format("the residuals are not clean after the best {} together (p = {:.2g})",
                                       groups_.front().additions.size(), p));
      }
    }
    one(p);
    unexplained(fmt::format("the residuals are not clean after the best mechanism (p = {:.2g})", p));
  }

 private:
  [[nodiscard]] const Hypothesis& hypothesis(const Direction& direction) const {
    return d_.candidates[direction.candidate].hypotheses[direction.hypothesis];
  }

  /// The weights: first as the linearisation has them, then with the likeliest ones at finite amplitude.
  void singles() {
    const std::size_t C = d_.candidates.size();
    std::vector<std::vector<std::size_t>> of(C);
    for (std::size_t k = 0; k < d_.directions.size(); ++k) of[d_.directions[k].candidate].push_back(k);
    std::vector<double> linear(C, -INFINITY);
    for (std::size_t c = 0; c < C; ++c) linear[c] = weight(of[c], {});
    double largest = *std::max_element(linear.begin(), linear.end());
    std::vector<std::size_t> by_weight(C);
    std::iota(by_weight.begin(), by_weight.end(), std::size_t{0});
    std::stable_sort(by_weight.begin(), by_weight.end(), [&](auto a, auto b) { return linear[a] > linear[b]; });
    const std::size_t most = d_.settings.quick ? quick_refits : C;

    struct Job {
      std::size_t candidate, direction;
      std::optional<Refitted> refitted = {};
    };
    std::vector<Job> jobs;
    for (std::size_t place = 0; place < by_weight.size(); ++place) {
      const std::size_t c = by_weight[place];
      if (of[c].empty()) continue;
      if (place >= most || (d_.settings.quick && place >= 4 && linear[c] < largest - quick_reach)) continue;
      for (const std::size_t k : likeliest(of[c])) jobs.push_back({c, k});
    }
    tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t j) {
      const Direction& direction = d_.directions[jobs[j].direction];
      jobs[j].refitted =
          fit_with(d_, {hypothesis(direction).addition}, std::array{start_amplitude(jobs[j].direction)}, catalogue_);
    });
    singles_.resize(C);
    for (std::size_t c = 0; c < C; ++c) singles_[c].candidate = c, singles_[c].log_weight = linear[c];
    std::map<std::size_t, std::map<std::size_t, double>> gains;  // candidate → direction → gain
    for (Job& job : jobs) {
      Single& single = singles_[job.candidate];
      if (!job.refitted) continue;
      gains[job.candidate][job.direction] = d_.fit.chi2 - job.refitted->fit.chi2;
      if (!single.best || job.refitted->fit.chi2 < single.best->fit.chi2) {
        single.best = std::move(job.refitted), single.direction = job.direction;
      }
    }
    for (const auto& [c, gain] : gains) singles_[c].log_weight = weight(of[c], gain);
    for (std::size_t c = 0; c < C; ++c)
      if (std::isfinite(singles_[c].log_weight)) order_.push_back(c);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](auto a, auto b) { return singles_[a].log_weight > singles_[b].log_weight; });
    // Those that were not fitted again are no rivals: they are too far behind.
    std::stable_partition(order_.begin(), order_.end(), [&](auto c) { return singles_[c].best.has_value(); });
  }

  /// ln w of a candidate, with gains at finite amplitude in place of T where they are known.
  [[nodiscard]] double weight(const std::vector<std::size_t>& directions,
                              const std::map<std::size_t, double>& gains) const {
    std::vector<double> logs;
    for (const std::size_t k : directions) {
      const auto found = gains.find(k);
      const double T = found == gains.end() ? scores_[k].T : std::max(found->second, 0.0);
      logs.push_back(T / 2 + log_side(d_.directions[k].side, T));
    }
    return log_sum(logs) - std::log(static_cast<double>(std::max<std::size_t>(logs.size(), 1)));
  }

  /// The best hypothesis of a candidate, and of other targets those nearly as good; where T is 0 for all, the one a
  /// refit could still make something of.
  [[nodiscard]] std::vector<std::size_t> likeliest(const std::vector<std::size_t>& of) const {
    std::vector<std::size_t> sorted = of;
    std::stable_sort(sorted.begin(), sorted.end(), [&](auto a, auto b) { return scores_[a].T > scores_[b].T; });
    std::vector<std::size_t> chosen;
    std::vector<Target> seen;
    for (const std::size_t k : sorted) {
      const Target& target = hypothesis(d_.directions[k]).addition.target;
      if (std::find(seen.begin(), seen.end(), target) != seen.end()) continue;
      if (!chosen.empty() && scores_[k].T < scores_[chosen.front()].T - 6) break;
      if (chosen.size() >= (d_.settings.quick ? 2u : 4u)) break;
      seen.push_back(target), chosen.push_back(k);
    }
    return chosen;
  }

  /// Where the linearisation sees nothing on the admissible side, a tenth of a standard error of it.
  [[nodiscard]] double start_amplitude(std::size_t direction) const {
    const Score& found = scores_[direction];
    return found.T > 0 ? found.amplitude : 0.1 / d_.directions[direction].length;
  }

  /// The p-value of what is left with the additions, among all that was not added.
  double clean(const Refitted& refitted) const {
    const Projection projection(interior(refitted.fit));
    std::vector<Candidate> others = d_.candidates;
    for (Candidate& candidate : others)
      for (const Addition& addition : refitted.additions)
        if (candidate.id == addition.id) candidate.hypotheses.clear();
    const auto left = directions(others, projection);
    const Detection detection(projection, left, others.size(), shapes_, draws_);
    return detection.judge(-refitted.fit.residuals).p;
  }

  /// All pairs in the linearisation, the best of them at finite amplitude.
  void pairs() {
    // The best hypotheses of every candidate, alone and beside the best single.
    std::vector<std::size_t> chosen;
    const Projection beside(interior(singles_[order_.front()].best->fit));
    std::map<std::size_t, std::vector<std::pair<double, std::size_t>>> alone, next;
    const Eigen::VectorXd left = -singles_[order_.front()].best->fit.residuals;
    for (std::size_t k = 0; k < d_.directions.size(); ++k) {
      const Direction& direction = d_.directions[k];
      alone[direction.candidate].emplace_back(-scores_[k].T, k);
      const Eigen::VectorXd s = beside.off(hypothesis(direction).signature);
      if (!(s.norm() > invisible * hypothesis(direction).signature.norm())) continue;
      const double t = s.dot(left) / s.norm();
      next[direction.candidate].emplace_back(direction.side != Side::both && t < 0 ? 0 : -t * t, k);
    }
    std::set<std::size_t> pool;
    for (auto* ranking : {&alone, &next})
      for (auto& [candidate, list] : *ranking) {
        std::stable_sort(list.begin(), list.end());
        for (std::size_t i = 0; i < std::min<std::size_t>(list.size(), pair_pool); ++i) pool.insert(list[i].second);
      }
    chosen.assign(pool.begin(), pool.end());
    for (std::size_t i = 0; i < chosen.size(); ++i)
      for (std::size_t j = i + 1; j < chosen.size(); ++j) add_pair(chosen[i], chosen[j]);
    std::stable_sort(groups_.begin(), groups_.end(),
                     [](const Group& a, const Group& b) { return a.linear_gain > b.linear_gain; });
    // Of one pair of mechanisms the two best places.
    std::map<std::vector<std::size_t>, int> seen;
    std::erase_if(groups_, [&](const Group& group) { return ++seen[group.candidates] > 2; });
    if (groups_.size() > (d_.settings.quick ? quick_pairs : full_pairs))
      groups_.resize(d_.settings.quick ? quick_pairs : full_pairs);
    refit_groups();
    std::erase_if(groups_, [this](const Group& group) { return !group.refitted || !all_needed(group); });
  }

  /// The largest gain of two amplitudes on their admissible sides.
  void add_pair(std::size_t i, std::size_t j) {
    const Direction &a = d_.directions[i], &b = d_.directions[j];
    if (a.candidate == b.candidate) return;
    const double c = a.unit.dot(b.unit), ta = a.unit.dot(residuals_), tb = b.unit.dot(residuals_);
    if (1 - c * c < 0.02) return;
    const double xa = (ta - c * tb) / (1 - c * c), xb = (tb - c * ta) / (1 - c * c);
    if ((a.side != Side::both && xa <= 0) || (b.side != Side::both && xb <= 0)) return;
    Group group;
    group.candidates = {a.candidate, b.candidate};
    group.additions = {hypothesis(a).addition, hypothesis(b).addition};
    group.amplitudes = {xa / a.length, xb / b.length};
    group.linear_gain = ta * xa + tb * xb;
    groups_.push_back(std::move(group));
  }

  void refit_groups() {
    tbb::parallel_for(std::size_t{0}, groups_.size(), [&](std::size_t g) {
      if (groups_[g].refitted) return;
      groups_[g].refitted = fit_with(d_, groups_[g].additions, groups_[g].amplitudes, catalogue_);
    });
    std::stable_sort(groups_.begin(), groups_.end(), [](const Group& a, const Group& b) {
      if (!a.refitted || !b.refitted) return a.refitted.has_value() && !b.refitted.has_value();
      return a.refitted->fit.chi2 < b.refitted->fit.chi2;
    });
  }

  /// Each member loses significantly when it is taken out: the rest is fitted again without it.
  bool all_needed(const Group& group) const {
    for (std::size_t out = 0; out < group.additions.size(); ++out) {
      std::vector<Addition> rest;
      std::vector<double> amplitudes;
      for (std::size_t k = 0; k < group.additions.size(); ++k) {
        if (k == out) continue;
        rest.push_back(group.additions[k]), amplitudes.push_back(group.amplitudes[k]);
      }
      const auto without = fit_with(d_, rest, amplitudes, catalogue_);
      const double before = without ? std::min(without->fit.chi2, d_.fit.chi2) : d_.fit.chi2;
      if (before - group.refitted->fit.chi2 < detection_.threshold(group.candidates[out], second_alpha)) return false;
    }
    return true;
  }

  /// Adds to the best pair what explains most of what it leaves.
  void third() {
    const Group pair = groups_.front();
    const Projection projection(interior(pair.refitted->fit));
    const Eigen::VectorXd left = -pair.refitted->fit.residuals;
    std::vector<std::tuple<double, std::size_t, double>> ranking;
    std::set<std::size_t> seen;
    for (std::size_t k = 0; k < d_.directions.size(); ++k) {
      const Direction& direction = d_.directions[k];
      if (std::find(pair.candidates.begin(), pair.candidates.end(), direction.candidate) != pair.candidates.end())
        continue;
      const Eigen::VectorXd s = projection.off(hypothesis(direction).signature);
      if (!(s.norm() > invisible * hypothesis(direction).signature.norm())) continue;
      const double t = s.dot(left) / s.norm();
      if (direction.side == Side::both || t > 0) ranking.emplace_back(t * t, k, t / s.norm());
    }
    std::stable_sort(ranking.begin(), ranking.end(),
                     [](const auto& a, const auto& b) { return std::get<0>(a) > std::get<0>(b); });
    std::vector<Group> triples;
    for (const auto& [T, k, amplitude] : ranking) {
      if (triples.size() >= 6) break;
      if (!seen.insert(d_.directions[k].candidate).second) continue;
      Group triple = pair;
      triple.refitted.reset();
      triple.candidates.push_back(d_.directions[k].candidate);
      triple.additions.push_back(hypothesis(d_.directions[k]).addition), triple.amplitudes.push_back(amplitude);
      triples.push_back(std::move(triple));
    }
    std::swap(groups_, triples);
    refit_groups();
    std::erase_if(groups_, [this](const Group& group) { return !group.refitted || !all_needed(group); });
    if (groups_.empty()) std::swap(groups_, triples);
  }

  void one(double p) {
    d_.p_after = p, d_.named = 1;
    std::vector<double> logs;
    for (const std::size_t c : order_) logs.push_back(singles_[c].log_weight);
    const double all = log_sum(logs), best = singles_[order_.front()].log_weight;
    for (const std::size_t c : order_) {
      const Single& single = singles_[c];
      if (!single.best || 2 * (best - single.log_weight) > set_width) continue;
      Cause cause = cause_of(d_, *single.best, 0, d_.directions[single.direction], catalogue_);
      cause.probability = std::exp(single.log_weight - all);
      cause.p_value = d_.detection.by_candidate[c];
      d_.ambiguity_set.push_back(cause.id);
      d_.causes.push_back(std::move(cause));
    }
    d_.extension = singles_[order_.front()].best;
    if (const auto wrong = std::find_if(order_.begin(), order_.end(),
                                        [&](auto c) {
                                          return singles_[c].best &&
                                                 std::find(d_.ambiguity_set.begin(), d_.ambiguity_set.end(),
                                                           d_.candidates[c].id) == d_.ambiguity_set.end();
                                        });
        wrong != order_.end())
      set_best_wrong(d_.candidates[*wrong].id, singles_[*wrong].best->fit.chi2);
    judge();
  }

  void several(double p) {
    const Group& best = groups_.front();
    d_.p_after = p, d_.named = best.additions.size();
    d_.causes.clear(), d_.ambiguity_set.clear();
    std::vector<double> logs;
    for (const Group& group : groups_) logs.push_back(-group.refitted->fit.chi2 / 2);
    const double all = log_sum(logs);
    const auto add = [this](const std::string& id) {
      if (std::find(d_.ambiguity_set.begin(), d_.ambiguity_set.end(), id) == d_.ambiguity_set.end())
        d_.ambiguity_set.push_back(id);
    };
    for (std::size_t k = 0; k < best.additions.size(); ++k) {
      const auto direction = std::find_if(d_.directions.begin(), d_.directions.end(), [&](const Direction& candidate) {
        return hypothesis(candidate).addition.id == best.additions[k].id &&
               hypothesis(candidate).addition.target == best.additions[k].target;
      });
      Cause cause = cause_of(d_, *best.refitted, k, *direction, catalogue_);
      double share = -INFINITY;
      for (const Group& group : groups_)
        if (std::find(group.candidates.begin(), group.candidates.end(), best.candidates[k]) != group.candidates.end())
          share = log_sum({share, -group.refitted->fit.chi2 / 2});
      cause.probability = std::min(1.0, std::exp(share - all));
      cause.p_value = d_.detection.by_candidate[best.candidates[k]];
      d_.causes.push_back(std::move(cause));
      add(best.additions[k].id);
    }
    for (const Group& group : groups_) {
      if (group.candidates == best.candidates || group.additions.size() != 2) continue;
      if (group.refitted->fit.chi2 - best.refitted->fit.chi2 > set_width) continue;
      for (const Addition& addition : group.additions) add(addition.id);
      d_.alternatives.emplace_back(group.additions[0].id, group.additions[1].id);
    }
    d_.extension = best.refitted;
    for (const Group& group : groups_)
      if (group.refitted->fit.chi2 - best.refitted->fit.chi2 > set_width) {
        set_best_wrong(group.additions[0].id + " + " + group.additions[1].id, group.refitted->fit.chi2);
        break;
      }
    judge();
  }

  void set_best_wrong(const std::string& id, double chi2) {
    d_.gain.emplace();
    d_.gain->best_wrong = id, d_.gain->best_wrong_after = chi2;
  }

  /// The table of verdicts, for an explanation after which the residuals are clean.
  void judge() {
    const std::size_t rivals = d_.ambiguity_set.size();
    d_.verdict = rivals == d_.named       ? Verdict::named
                 : rivals <= d_.named + 3 ? Verdict::indistinguishable
                                          : Verdict::unknown;
    if (d_.verdict == Verdict::unknown)
      d_.reasons.push_back(fmt::format("{} mechanisms explain the misfit equally well", rivals));
    const Cause& first = d_.causes.front();
    if (d_.named == 1 && d_.verdict == Verdict::named) {
      if (first.target.row || catalogue_.mechanisms().at(first.id).factory.stage == Stage::data) {
        d_.verdict = Verdict::suspect_data;
        d_.reasons.push_back(fmt::format("the misfit sits {}, and nowhere else", first.target.words()));
      } else if (!first.amplitude.plausible || first.amplitude.at_bound) {
        d_.verdict = Verdict::suspect_data;
        d_.reasons.push_back(fmt::format("{} would have to be {:.3g} {}, which is {}", first.id, first.amplitude.value,
                                         first.amplitude.unit,
                                         first.amplitude.at_bound ? "at its bound" : "beyond what is plausible"));
      } else if (const std::string curve = carrier(d_, d_.directions[singles_[order_.front()].direction], residuals_);
                 !curve.empty()) {
        d_.verdict = Verdict::suspect_data;
        d_.reasons.push_back("the effect should show in several curves and is carried by one: " + curve);
      }
    }
  }

  void unexplained(const std::string& why) {
    d_.verdict = Verdict::unknown;
    d_.reasons.push_back(why);
  }

  static constexpr std::size_t quick_refits = 10, quick_pairs = 8, full_pairs = 24, pair_pool = 2;
  static constexpr double quick_reach = 9;  ///< of ln w

  Diagnosis& d_;
  const Detection& detection_;
  const Eigen::MatrixXf& draws_;
  const Shapes& shapes_;
  const plugins::Catalogue& catalogue_;
  Eigen::VectorXd residuals_;  ///< measured − predicted
  std::vector<Score> scores_;
  std::vector<Single> singles_;
  std::vector<std::size_t> order_;  ///< candidates, likeliest first
  std::vector<Group> groups_;       ///< best first
};

}  // namespace

void name_causes(Diagnosis& diagnosis, const Detection& detection, const Eigen::MatrixXf& draws, const Shapes& shapes,
                 const plugins::Catalogue& catalogue) {
  Naming(diagnosis, detection, draws, shapes, catalogue).run();
}

}  // namespace tunica::diagnosis
