// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/combination.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cohort_diagnosis/alarm.hpp"
#include "cohort_diagnosis/cohort_size.hpp"
#include "cohort_diagnosis/common_amplitude.hpp"
#include "cohort_diagnosis/contradictions.hpp"
#include "cohort_diagnosis/groups.hpp"
#include "cohort_diagnosis/left_out.hpp"
#include "cohort_diagnosis/pairs.hpp"
#include "cohort_diagnosis/remainder.hpp"
#include "diagnosis/naming/credible.hpp"
#include "diagnosis/naming/groups.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort_diagnosis {
namespace {

using diagnosis::Verdict;

/// Below which what an explanation leaves of all specimens together is no noise. The vectors are those of the best
/// amplitudes, and r is not as straight as they are: the bar is lower than that of one specimen.
constexpr double not_clean = 1e-4;

/// An explanation, and the hypotheses that explain most of it.
struct Candidate {
  Explanation explanation;
  std::vector<std::size_t> best;  ///< hypotheses
};

class Combination {
 public:
  Combination(const Specimens& specimens, std::span<const Factor> factors)
      : specimens_(specimens),
        factors_(factors),
        levels_(levels_of(specimens, factors)),
        hypotheses_(hypotheses_of(specimens)) {
    for (const Hypothesis& one : hypotheses_) logs_.push_back(log_evidence(one, levels_, specimens_.size()));
  }

  void explain(CohortVerdict& found) {
    std::vector<Candidate> all = singles();
    if (all.empty()) {
      found.verdict = Verdict::unknown;
      found.reasons.push_back({CohortReasonKind::no_trace, "no mechanism leaves a trace in these data"});
      return;
    }
    picture(all, found);
    const std::size_t mechanisms = all.size();
    for (Candidate& pair : pairs(mechanisms)) all.push_back(std::move(pair));
    std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
      return a.explanation.log_weight > b.explanation.log_weight;
    });
    leave_out_additions(all);
    share_out_probability(all);
    const Candidate& best = all.front();
    std::vector<const Hypothesis*> causes;
    for (const std::size_t k : best.best) causes.push_back(&hypotheses_[k]);
    found.named = causes.size();
    std::vector<bool> who(specimens_.size(), true);
    if (causes.size() == 1) {
      found.factors = factors_of(*causes.front(), levels_, factors_, specimens_.size());
      who = affected(found.factors, levels_, specimens_.size());
    }
    for (const Hypothesis* cause : causes) found.amplitudes.push_back(common_amplitude(*cause, who));
    found.p_rest = rest_of(specimens_, causes).p();
    if (causes.size() == 1) found.left_out = left_out(specimens_, *causes.front(), who);
    found.contradictions = contradictions_of(specimens_, causes, hypotheses_, who);
    claim(all, found);
    for (Candidate& one : all) found.explanations.push_back(std::move(one.explanation));
  }

 private:
  [[nodiscard]] Candidate candidate(std::vector<std::size_t> best, double log_evidence) const {
    Candidate made{{}, std::move(best)};
    for (const std::size_t k : made.best) {
      const Profile& like = hypotheses_[k].like();
      made.explanation.ids.push_back(like.id);
      made.explanation.places.push_back(like.place);
      made.explanation.settings.push_back(like.setting);
    }
    made.explanation.log_evidence = log_evidence;
    return made;
  }

  /// Each mechanism: its places and settings summed.
  [[nodiscard]] std::vector<Candidate> singles() const {
    std::map<std::string, std::vector<std::size_t>> of;
    for (std::size_t k = 0; k < hypotheses_.size(); ++k) of[hypotheses_[k].id()].push_back(k);
    std::vector<Candidate> all;
    for (const auto& [id, own] : of) {
      std::vector<double> logs;
      std::size_t best = own.front();
      for (const std::size_t k : own) {
        logs.push_back(hypotheses_[k].log_share + logs_[k]);
        if (logs.back() > hypotheses_[best].log_share + logs_[best]) best = k;
      }
      Candidate made = candidate({best}, logs_[best]);
      made.explanation.log_weight = log_sum_exp(logs);
      all.push_back(std::move(made));
    }
    std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
      return a.explanation.log_weight > b.explanation.log_weight;
    });
    return all;
  }

  /// Of two mechanisms what their places and settings say together, with the odds that there are two.
  [[nodiscard]] std::vector<Candidate> pairs(std::size_t mechanisms) const {
    std::map<std::pair<std::string, std::string>, std::vector<Pair>> of;
    std::vector<std::pair<std::string, std::string>> order;
    for (const Pair& pair : pairs_of(specimens_, hypotheses_)) {
      const std::pair ids{hypotheses_[pair.a].id(), hypotheses_[pair.b].id()};
      if (!of.contains(ids)) order.push_back(ids);
      of[ids].push_back(pair);
    }
    std::vector<Candidate> all;
    for (const auto& ids : order) {
      const std::vector<Pair>& own = of.at(ids);
      std::vector<double> logs;
      for (const Pair& pair : own)
        logs.push_back(pair.log_evidence + hypotheses_[pair.a].log_share + hypotheses_[pair.b].log_share);
      Candidate made = candidate({own.front().a, own.front().b}, own.front().log_evidence);
      made.explanation.log_weight = log_sum_exp(logs) + diagnosis::log_odds_of_pair(mechanisms);
      all.push_back(std::move(made));
    }
    return all;
  }

  /// A pair that contains the leading single mechanism is not another explanation; it only adds more than the data
  /// require.
  static void leave_out_additions(std::vector<Candidate>& all) {
    if (all.front().best.size() > 1) return;
    const std::string leader = all.front().explanation.ids.front();
    std::erase_if(all, [&](const Candidate& one) {
      const std::vector<std::string>& ids = one.explanation.ids;
      return ids.size() > 1 && std::find(ids.begin(), ids.end(), leader) != ids.end();
    });
  }

  /// Probabilities over all, and the credible set.
  static void share_out_probability(std::vector<Candidate>& all) {
    std::vector<double> logs;
    for (const Candidate& one : all) logs.push_back(one.explanation.log_weight);
    const double sum = log_sum_exp(logs);
    double mass = 0;
    for (Candidate& one : all) {
      one.explanation.probability = std::exp(one.explanation.log_weight - sum);
      one.explanation.in_set = mass < diagnosis::set_mass;
      mass += one.explanation.probability;
    }
  }

  /// Mean over the specimens of the cosine of what two hypotheses leave.
  [[nodiscard]] double likeness(std::size_t a, std::size_t b) const {
    if (a == b) return 1;
    double sum = 0, count = 0;
    for (std::size_t s = 0; s < specimens_.size(); ++s) {
      const Hypothesis &first = hypotheses_[a], &second = hypotheses_[b];
      if (!first.sees[s] || !second.sees[s]) continue;
      sum += std::abs(cosine_of(*specimens_[s], first.seen[s], second.seen[s]));
      count += 1;
    }
    return count > 0 ? sum / count : 0;
  }

  [[nodiscard]] bool alike(const Candidate& a, const Candidate& b) const {
    if (a.best.size() != b.best.size()) return false;
    const auto same = [this](std::size_t i, std::size_t j) {
      return hypotheses_[i].id() == hypotheses_[j].id() || likeness(i, j) > diagnosis::look_alike;
    };
    if (a.best.size() == 1) return same(a.best[0], b.best[0]);
    return (same(a.best[0], b.best[0]) && same(a.best[1], b.best[1])) ||
           (same(a.best[0], b.best[1]) && same(a.best[1], b.best[0]));
  }

  void claim(const std::vector<Candidate>& all, CohortVerdict& found) const {
    std::vector<const Candidate*> classes;
    std::size_t members = 0;
    for (const Candidate& one : all) {
      if (!one.explanation.in_set) continue;
      ++members;
      for (const std::string& id : one.explanation.ids)
        if (std::find(found.ambiguity_set.begin(), found.ambiguity_set.end(), id) == found.ambiguity_set.end())
          found.ambiguity_set.push_back(id);
      std::size_t at = 0;
      while (at < classes.size() && !alike(*classes[at], one)) ++at;
      if (at == classes.size()) {
        classes.push_back(&one);
        found.look_alikes.emplace_back();
      }
      found.look_alikes[at].push_back(fmt::format("{}", fmt::join(one.explanation.ids, " + ")));
    }
    found.verdict = members == 1 ? Verdict::named : Verdict::indistinguishable;
    if (found.p_rest < not_clean) {
      found.verdict = Verdict::unknown;
      found.reasons.push_back({CohortReasonKind::not_clean,
                               fmt::format("what {} {} of all specimens together is no noise ({})",
                                           fmt::join(all.front().explanation.ids, " and "),
                                           all.front().best.size() > 1 ? "leave" : "leaves", p_words(found.p_rest))});
    } else if (classes.size() > diagnosis::most_explanations) {
      found.verdict = Verdict::unknown;
      found.reasons.push_back(
          {CohortReasonKind::many_explanations,
           fmt::format("{} explanations that do not look alike are about equally likely", classes.size())});
    } else if (found.verdict == Verdict::named) {
      suspect(all.front(), found);
    }
  }

  /// Signs of a fault in the data: a single row, or one specimen, carries the whole effect.
  void suspect(const Candidate& best, CohortVerdict& found) const {
    if (best.best.size() > 1) return;
    const Hypothesis& cause = hypotheses_[best.best.front()];
    if (cause.like().place.row) {
      found.verdict = Verdict::suspect_data;
      found.reasons.push_back({CohortReasonKind::single_place,
                               fmt::format("the misfit sits {}, and nowhere else", cause.like().place.words())});
      return;
    }
    const std::vector<bool> everyone(specimens_.size(), true);
    const double all = cause.log_evidence(everyone);
    for (std::size_t s = 0; specimens_.size() > 1 && s < specimens_.size(); ++s) {
      std::vector<bool> others = everyone;
      others[s] = false;
      if (all > 3 && cause.log_evidence(others) < 0) {
        found.verdict = Verdict::suspect_data;
        found.reasons.push_back(
            {CohortReasonKind::one_specimen, fmt::format("the specimen '{}' alone shows it", specimens_[s]->id)});
        return;
      }
    }
  }

  void picture(const std::vector<Candidate>& singles, CohortVerdict& found) const {
    const std::vector<bool> everyone(specimens_.size(), true);
    for (const Candidate& one : singles) {
      const Hypothesis& hypothesis = hypotheses_[one.best.front()];
      const Population& population = hypothesis.likeliest(everyone);
      MatrixRow row{hypothesis.id(), hypothesis.like().place, {}};
      for (std::size_t s = 0; s < specimens_.size(); ++s)
        row.log_evidence.push_back(hypothesis.sees[s] ? log_marginal(hypothesis.seen[s], population) : 0);
      found.matrix.push_back(std::move(row));
      std::vector<double>& alike = found.likeness.emplace_back();
      for (const Candidate& other : singles) alike.push_back(likeness(one.best.front(), other.best.front()));
    }
  }

  const Specimens& specimens_;
  std::span<const Factor> factors_;
  std::vector<Level> levels_;
  std::vector<Hypothesis> hypotheses_;
  std::vector<double> logs_;  ///< ln of the evidence of each hypothesis
};

}  // namespace

std::string p_words(double p) { return p < 1e-12 ? "p < 1e-12" : fmt::format("p = {:.1g}", p); }

const char* code_of(ContradictionKind kind) {
  switch (kind) {
    case ContradictionKind::not_seen:
      return "not_seen";
    case ContradictionKind::other_size:
      return "other_size";
    case ContradictionKind::other_cause:
      return "other_cause";
    case ContradictionKind::rest_is_left:
      return "rest_is_left";
    case ContradictionKind::shows_effect:
      break;
  }
  return "shows_effect";
}

const char* code_of(CohortReasonKind kind) {
  switch (kind) {
    case CohortReasonKind::no_alarm:
      return "no_alarm";
    case CohortReasonKind::many_explanations:
      return "many_explanations";
    case CohortReasonKind::not_clean:
      return "not_clean";
    case CohortReasonKind::no_trace:
      return "no_trace";
    case CohortReasonKind::single_place:
      return "single_place";
    case CohortReasonKind::one_specimen:
      break;
  }
  return "one_specimen";
}

CohortVerdict combine(std::span<const SpecimenEvidence> given, std::span<const Factor> factors,
                      const Request& request) {
  if (given.empty()) throw InputError("a cohort of no specimens has no verdict. Name one specimen at least");
  const Specimens specimens = in_order(given);
  CohortVerdict found;
  for (std::size_t s = 0; s < specimens.size(); ++s) {
    if (s > 0 && specimens[s]->id == specimens[s - 1]->id)
      throw InputError(fmt::format("two specimens have the id '{}'. Name each differently", specimens[s]->id));
    found.specimens.push_back(specimens[s]->id);
    found.p_values.push_back(specimens[s]->p_value);
  }
  (void)levels_of(specimens, factors);
  found.p_value = p_of_cohort(specimens);
  found.alarm = found.p_value <= request.alpha;
  found.size = size_of(specimens);
  if (found.alarm) {
    Combination(specimens, factors).explain(found);
  } else {
    found.reasons.push_back(
        {CohortReasonKind::no_alarm, "noise explains what the fits leave of all specimens together"});
  }
  return found;
}

}  // namespace tunica::cohort_diagnosis
