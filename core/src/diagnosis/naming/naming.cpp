// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/naming.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/evidence/stand_ins.hpp"
#include "diagnosis/hypotheses/places.hpp"
#include "diagnosis/naming/causes.hpp"
#include "diagnosis/naming/credibility.hpp"
#include "diagnosis/naming/credible.hpp"
#include "diagnosis/naming/remainder.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double most_of_it = 0.8, half_of_it = 0.5;

Explanation unexplained(ReasonKind kind, std::string why) {
  Explanation found;
  found.verdict = Verdict::unknown;
  found.reasons.push_back({kind, std::move(why)});
  return found;
}

/// "no mechanism of the group rig leaves a trace in these data"
std::string no_trace_words(const Request& request) {
  const std::string material = code_of(CauseGroup::material), rig = code_of(CauseGroup::rig);
  if (request.considers(material) && request.considers(rig))
    return "no mechanism of the catalogue leaves a trace in these data";
  if (!request.considers(material) && !request.considers(rig))
    return "no mechanism was looked for, because \"groups\" leaves out material and rig";
  return fmt::format("no mechanism of the group {} leaves a trace in these data",
                     request.considers(rig) ? rig : material);
}

/// Every mechanism as the only explanation, likeliest first.
std::vector<RankedMechanism> ranking_of(const Analysis& analysis, const std::vector<Single>& singles) {
  const Fit& fit = analysis.evidence.fit;
  const Hypotheses& hypotheses = analysis.hypotheses;
  std::vector<double> logs;
  for (const Single& single : singles) logs.push_back(single.log_weight);
  const double all = log_sum(logs);
  std::vector<RankedMechanism> ranking;
  for (const Single& single : singles) {
    const Direction& direction = hypotheses.directions[single.direction];
    RankedMechanism ranked{hypotheses.candidates[direction.candidate].id,
                           hypotheses.hypothesis(direction).addition.place, std::exp(single.log_weight - all),
                           score(direction, -fit.residuals).T, std::nullopt};
    ranked.group = group_of(*hypotheses.candidates[direction.candidate].mechanism);
    if (single.best) ranked.gain = fit.chi2 - single.best->fit.chi2;
    ranking.push_back(std::move(ranked));
  }
  return ranking;
}

/// An explanation that was chosen, and what it leaves.
struct Choice {
  WeighedClaim weighed;
  double p_after = 1;
  bool clean = true;
};

/// Between one mechanism and several.
class Contest {
 public:
  Contest(const Inquiry& inquiry, const Analysis& analysis, const std::vector<Single>& singles,
          const std::vector<RankedMechanism>& ranking)
      : inquiry_(inquiry), analysis_(analysis), singles_(singles), ranking_(ranking) {}

  [[nodiscard]] Choice winner() const {
    const Single& single = singles_.front();
    const double p_one = p_of_remainder(analysis_, *single.best);
    if (!is_clean(p_one) && !is_worth_company(single)) return one(p_one, false);
    // Where one may be enough, two must be worth their price.
    const double floor = is_clean(p_one) ? single.log_weight - log_odds_of_pair(singles_.size()) : -INFINITY;
    std::vector<Group> groups = fit_pairs(inquiry_, analysis_, singles_, floor);
    weigh_credibility(inquiry_, analysis_, groups);
    if (groups.empty() || groups.front().log_weight < floor) return one(p_one, is_clean(p_one));
    double p = p_of_remainder(analysis_, *groups.front().refit);
    if (is_clean(p)) return several(groups, p);
    if (auto triples = fit_triples(inquiry_, analysis_, groups); !triples.empty()) {
      weigh_credibility(inquiry_, analysis_, triples);
      groups = std::move(triples);
      p = p_of_remainder(analysis_, *groups.front().refit);
    }
    if (is_clean(p) || !one_is_worth_more(groups.front())) return several(groups, p);
    return one(p_one, false);  // something is left that neither explains
  }

 private:
  [[nodiscard]] Choice one(double p_after, bool clean) const {
    return {claim_one(inquiry_, analysis_, singles_, ranking_), p_after, clean};
  }
  [[nodiscard]] Choice several(const std::vector<Group>& groups, double p_after) const {
    return {claim_several(inquiry_, analysis_, groups, singles_, is_clean(p_after)), p_after, is_clean(p_after)};
  }

  /// Where a budget with a cheaper method follows, several are fitted together beside one that takes half of the
  /// misfit. The budget asks of the others.
  [[nodiscard]] bool is_worth_company(const Single& single) const {
    const Fit& fit = analysis_.evidence.fit;
    return fit.chi2 - single.best->fit.chi2 > half_of_it * (fit.chi2 - static_cast<double>(fit.residuals.size())) ||
           !cheaper_budget_follows();
  }
  [[nodiscard]] bool cheaper_budget_follows() const {
    const Evidence& evidence = analysis_.evidence;
    const plugins::Catalogue& catalogue = inquiry_.catalogue;
    return evidence.base->layout().has_costly_tests && inquiry_.request.discovers &&
           can_search_terms(inquiry_.request, evidence, catalogue) &&
           StandIns(evidence.experiment, evidence.run, catalogue).suffice(evidence.experiment, evidence.run, catalogue);
  }

  /// Where nothing explains it all. What one mechanism does to most of it is worth more than what three do to a little
  /// more, and so is what is likelier.
  [[nodiscard]] bool one_is_worth_more(const Group& group) const {
    const Fit& fit = analysis_.evidence.fit;
    const Single& single = singles_.front();
    // An explanation with an implausible amplitude ranks below several with plausible ones.
    if (!is_credible(inquiry_, analysis_, *single.best, {single.direction}) &&
        is_credible(inquiry_, analysis_, *group.refit, group.directions))
      return false;
    const double rows = static_cast<double>(fit.residuals.size());
    const double odds = static_cast<double>(group.additions.size() - 1) * log_odds_of_pair(singles_.size());
    return fit.chi2 - single.best->fit.chi2 > most_of_it * (fit.chi2 - rows) ||
           single.log_weight > group.log_weight + odds;
  }

  const Inquiry& inquiry_;
  const Analysis& analysis_;
  const std::vector<Single>& singles_;
  const std::vector<RankedMechanism>& ranking_;
};

/// The evidence in the data for a single cause, or for causes without a rival; none without evidence.
std::optional<Reason> suspicion(const Inquiry& inquiry, const Analysis& analysis, const WeighedClaim& weighed) {
  const Claim& claim = weighed.claim;
  const Cause& first = claim.causes.front();
  if (claim.named == 1 && inquiry.mechanism(first.id).stage == Stage::data)
    return Reason{ReasonKind::single_place, fmt::format("the misfit sits {}, and nowhere else", first.place.words())};
  for (std::size_t k = 0; k < claim.named; ++k) {
    const Cause& cause = claim.causes[k];
    const Amplitude& amplitude = cause.amplitude;
    if (amplitude.plausible && !amplitude.at_bound) continue;
    return Reason{amplitude.at_bound ? ReasonKind::at_bound : ReasonKind::implausible,
                  fmt::format("{} would have to be {:.3g}{}, which is {}", cause.id, amplitude.value,
                              amplitude.unit == "1" ? "" : " " + amplitude.unit,
                              amplitude.at_bound ? "at its bound" : "beyond what is plausible")};
  }
  if (claim.named > 1) return std::nullopt;
  const auto shown = carried_by_one_test(analysis, analysis.hypotheses.directions[weighed.directions.front()]);
  if (!shown) return std::nullopt;
  return Reason{ReasonKind::single_carrier,
                "the effect should show in several curves but only one carries it: " + *shown};
}

/// The table of verdicts, for an explanation after which the residuals are clean.
Explanation concluded(const Inquiry& inquiry, const Analysis& analysis, const WeighedClaim& weighed,
                      Explanation found) {
  if (!weighed.alone && weighed.explanations > most_explanations) {
    found.verdict = Verdict::unknown;
    found.reasons.push_back(
        {ReasonKind::many_explanations,
         fmt::format("{} explanations that do not look alike are about equally likely", weighed.explanations)});
    return found;
  }
  found.verdict = weighed.alone ? Verdict::named : Verdict::indistinguishable;
  if (!weighed.correction.empty()) {
    found.verdict = Verdict::indistinguishable;
    found.unlisted = true;
    found.reasons.push_back(
        {ReasonKind::shape_correction,
         fmt::format("{} explains almost nothing without the others and may only correct their shape",
                     weighed.correction)});
  }
  if (found.verdict != Verdict::named) return found;
  if (auto doubt = suspicion(inquiry, analysis, weighed)) {
    found.verdict = Verdict::suspect_data;
    found.reasons.push_back(std::move(*doubt));
  }
  return found;
}

}  // namespace

bool can_search_terms(const Request& request, const Evidence& evidence, const plugins::Catalogue& catalogue) {
  return request.mechanisms.empty() && request.considers(code_of(CauseGroup::material)) && !request.model.empty() &&
         evidence.base->models().count() == 1 && catalogue.term_model() != nullptr;
}

Explanation named_causes(const Inquiry& inquiry, const Analysis& analysis) {
  std::vector<Single> singles = fit_singles(inquiry, analysis);
  weigh_credibility(inquiry, analysis, singles);
  if (singles.empty() && inquiry.request.mechanisms.empty())
    return unexplained(ReasonKind::no_trace, no_trace_words(inquiry.request));
  if (singles.empty())
    return unexplained(ReasonKind::no_trace_of_requested,
                       "none of the requested mechanisms leaves a trace in these data");
  if (!singles.front().best) return unexplained(ReasonKind::no_fit, "no mechanism could be fitted at finite amplitude");

  Explanation found;
  found.ranking = ranking_of(analysis, singles);
  const Choice choice = Contest(inquiry, analysis, singles, found.ranking).winner();
  found.best_direction.resize(analysis.hypotheses.candidates.size());
  for (const Single& single : singles) found.best_direction[single.candidate] = single.direction;
  for (const std::size_t k : choice.weighed.directions)
    found.best_direction[analysis.hypotheses.directions[k].candidate] = k;
  found.p_after = choice.p_after;
  const WeighedClaim& weighed = choice.weighed;
  found.claim = weighed.claim;
  return choice.clean ? concluded(inquiry, analysis, weighed, std::move(found))
                      : unclean(inquiry, analysis, std::move(found));
}

Explanation unclean(const Inquiry& inquiry, const Analysis& analysis, Explanation explanation) {
  const Claim& claim = explanation.claim;
  const Fit& fit = analysis.evidence.fit;
  std::vector<std::string> ids;
  for (std::size_t k = 0; k < claim.named; ++k) ids.push_back(claim.causes[k].id);
  const double rows = static_cast<double>(fit.residuals.size());
  const double share = (fit.chi2 - claim.best->fit.chi2) / std::max(fit.chi2 - rows, 1.0);
  const double p = explanation.p_after;
  explanation.verdict = Verdict::unknown;
  explanation.reasons.push_back(
      {ReasonKind::not_clean,
       fmt::format("{} {} {:.0f} % of the misfit beyond noise; the remaining misfit is not noise (p {})",
                   fmt::join(ids, " and "), ids.size() == 1 ? "explains" : "explain", 100 * std::clamp(share, 0.0, 1.0),
                   p < 1e-4 ? "< 0.0001" : fmt::format("= {:.2g}", p))});
  if (const auto clean = noise_that_explains_remainder(inquiry, analysis, *claim.best)) {
    explanation.noise_factor = clean->factor;
    explanation.reasons.push_back(
        {ReasonKind::larger_noise,
         fmt::format("noise would have to be {:.1f} times larger to explain the rest, and the base model would {}",
                     clean->factor, clean->base_still_wrong ? "still fail" : "then fit as well")});
  }
  return explanation;
}

}  // namespace tunica::diagnosis
