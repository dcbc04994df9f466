// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "budget/decision.hpp"
#include "budget/next_step.hpp"
#include "budget/output/outputs.hpp"
#include "budget/tie.hpp"
#include "diagnosis/naming/causes.hpp"
#include "diagnosis/naming/unseen_rivals.hpp"
#include "diagnosis/prospects/gain.hpp"
#include "text/lists.hpp"
#include "text/units.hpp"

namespace tunica::budget {
namespace {

using diagnosis::Explanation;
using diagnosis::ReasonKind;
using diagnosis::Verdict;

/// Of the steps of the same cause; of a contender that is no step its own.
double share_of(const Budget& budget, const Contender& contender) {
  double sum = 0;
  for (const Step& step : budget.steps)
    if (step.id == contender.id) sum += step.shapley;
  return std::max(sum, contender.share);
}

/// What a contender is a kind of: "a law of the first invariant", "axial fibres", or its id.
std::string class_of(const Contender& contender) {
  if (contender.sort == "I1") return "a law of the first invariant";
  if (contender.sort == "I2") return "a law of the second invariant";
  if (contender.sort == "J") return "a law of the volume";
  if (contender.sort == "stretches") return "a law of the principal stretches";
  constexpr std::string_view fibre = "fibre ";
  if (contender.sort.starts_with(fibre)) return contender.sort.substr(fibre.size()) + " fibres";
  return contender.id;
}

/// "; that it is a smooth misfit without a listed cause has probability 0.24", where that is not excluded.
std::string doubt_words(const Budget& budget) {
  if (budget.unlisted_probability <= 1 - sure_enough) return {};
  return fmt::format("; that it is a smooth misfit without a listed cause has probability {:.2f}",
                     budget.unlisted_probability);
}

/// "; causes were weighed with a cheaper method of plate, and fitted together with the own one they take 91 %"
std::string cheaper_words(const Budget& budget) {
  if (!budget.cheaper) return {};
  const auto& share = budget.cheaper->own_share;
  return fmt::format("; causes were weighed with a cheaper method of {}, and {}",
                     fmt::join(budget.cheaper->tests, ", "),
                     share ? fmt::format("fitted together with the own one they take {}", percent(*share))
                           : "were not fitted with the own one");
}

/// `stable`: the base is a material. Where it is none, what leads mends that too, and its form says nothing.
std::string leading_words(const Budget& budget, const Decision& decision, bool stable) {
  const Contender& first = *decision.first.front();
  const std::string misfit = the_misfit(budget);
  if (!stable && first.in_the_energy)
    return fmt::format(
        "mainly {}{}: it takes {} of {}; the base is not stable as it is fitted, so that the "
        "form of the law is open; {}",
        class_of(first), place_words(first.place), percent(share_of(budget, first)), misfit,
        remains(budget.rest(), budget.tolerance));
  std::vector<std::string> forms;
  std::set<std::string> said{first.id};
  for (std::size_t k = 1; k < decision.first.size() && forms.size() < 3; ++k)
    if (said.insert(decision.first[k]->id).second)
      forms.push_back(fmt::format("{} {}", decision.first[k]->id, percent(decision.first[k]->share)));
  const bool acts_like = first.in_the_energy && !first.id.starts_with(first.sort);
  const std::string like = acts_like ? fmt::format(", which acts like a law of {} here", first.sort) : "";
  std::string text = fmt::format("mainly {}{}{}{}: it takes {} of {}", first.term ? "the term " : "", first.id, like,
                                 place_words(first.place), percent(share_of(budget, first)), misfit);
  std::vector<std::string> others;
  std::size_t own = 0;
  for (const Step& step : budget.steps) {
    if (step.id == first.id)
      ++own;
    else
      others.push_back(step.id);
  }
  if (own > 1) text += fmt::format(" in {} steps", own);
  if (first.belief == Belief::flagged) text += ", with an amplitude somewhat beyond what is plausible";
  if (own <= 1 && !others.empty()) text += fmt::format(" and leaves {} of the range", percent(first.rest.rms));
  if (!forms.empty()) text += fmt::format("; its form is open ({} alone)", fmt::join(forms, ", "));
  if (others.empty()) return text + "; " + remains(budget.rest(), budget.tolerance);
  return fmt::format("{}; with {}, {}", text, fmt::join(others, " and "), remains(budget.rest(), budget.tolerance));
}

std::string unknown_words(const Budget& budget) {
  if (budget.rough)
    return fmt::format(
        "the base {}, and what the best cause leaves is rougher than a smooth misfit: the noise "
        "is larger than it is taken here, or a cause with fine structure is not listed",
        text::misses_by(budget.base.rms));
  std::string text = "the base " + text::misses_by(budget.base.rms);
  if (budget.base.rms <= budget.tolerance.share)
    text += fmt::format(", which is within the tolerance ({}, {})", percent(budget.tolerance.share),
                        origin_words(budget.tolerance));
  if (budget.contenders.empty()) return text;
  // A test with parameters of its own takes much, whatever the cause is.
  const auto& all = budget.contenders;
  const auto listed = std::find_if(all.begin(), all.end(), [](const Contender& one) { return !one.is_state(); });
  const Contender& best = listed == all.end() ? all.front() : *listed;
  text += fmt::format("; the best single cause, {}{}, takes {}{}", best.id, place_words(best.place),
                      percent(best.share), price(best));
  if (best.belief == Belief::beyond) text += " with an amplitude that is beyond belief";
  if (const std::string doubt = doubt_words(budget); !doubt.empty())
    text += doubt;
  else if (best.share < most_of_it)
    text += fmt::format(", and no {}cause takes half", all.front().is_state() ? "listed " : "");
  const Contender& most = all.front();
  const bool state_said = most.is_state() && best.share < most_of_it;
  if (state_said)
    text += fmt::format("; {}{} takes {}{}", most.id, place_words(most.place), percent(most.share), price(most));
  const Contender& likeliest = *std::max_element(
      all.begin(), all.end(), [](const Contender& a, const Contender& b) { return a.probability < b.probability; });
  if (&likeliest != &best && !(state_said && &likeliest == &most) &&
      likeliest.probability > std::max(best.probability, 1 - sure_enough))
    text += fmt::format("; the likeliest cause, {}{}, takes {} and has probability {:.2f}", likeliest.id,
                        place_words(likeliest.place), percent(likeliest.share), likeliest.probability);
  return text;
}

/// The causes of a mixture that is made of mechanisms only.
void claim(const diagnosis::Inquiry& inquiry, const diagnosis::Analysis& analysis, const Budget& budget,
           const Mixture& mixture, Explanation& explanation) {
  diagnosis::Refit refit{mixture.extension->additions(), mixture.extension, mixture.fit};
  diagnosis::Claim claim;
  claim.named = refit.additions.size();
  for (std::size_t k = 0; k < refit.additions.size(); ++k) {
    const diagnosis::Addition& addition = refit.additions[k];
    for (const diagnosis::Direction& direction : analysis.hypotheses.directions) {
      const diagnosis::Addition& own = analysis.hypotheses.hypothesis(direction).addition;
      if (own.id != addition.id || !(own.place == addition.place)) continue;
      diagnosis::Cause cause = diagnosis::cause_of(inquiry, analysis, refit, k, direction);
      for (const Contender& one : budget.contenders)
        if (one.id == cause.id && one.place == cause.place)
          cause.probability = std::max(cause.probability, one.probability);
      cause.p_value = analysis.alarm.detector->candidate_p(direction.candidate, cause.gain);
      claim.causes.push_back(std::move(cause));
      break;
    }
    if (std::find(claim.ambiguity_set.begin(), claim.ambiguity_set.end(), addition.id) == claim.ambiguity_set.end())
      claim.ambiguity_set.push_back(addition.id);
  }
  claim.rivals = {refit};
  claim.best = std::move(refit);
  explanation.claim = std::move(claim);
}

void add_anisotropy(const Budget& budget, Explanation& explanation) {
  if (!budget.anisotropy.empty()) explanation.reasons.push_back({ReasonKind::anisotropy_seen, budget.anisotropy});
}

/// Takes back what the diagnosis says of its best causes, which leave more than noise.
void withdraw_causes(diagnosis::Diagnosis& d) {
  d.explanation.noise_factor.reset();
  d.explanation.unlisted = false;
  d.explanation.claim = {};
  d.prospects.gain.reset();
  d.prospects.next.reset();
}

/// Read otherwise, the file takes at least as much of the misfit as what would lead: no cause is named, and the
/// question stands first.
void ask_of_the_file(const Budget& budget, diagnosis::Diagnosis& d) {
  const bool most =
      std::ranges::all_of(budget.contenders, [&](const Contender& one) { return one.share <= budget.of_file.share; });
  withdraw_causes(d);
  d.explanation.verdict = Verdict::indistinguishable;
  d.explanation.reasons = {
      {ReasonKind::file_as_likely,
       fmt::format("is what the file says so? If {}, {} of the misfit is gone{}; try {}", budget.of_file.sentence,
                   percent(budget.of_file.share), most ? ", and no cause takes more" : "", budget.of_file.mend)},
      {ReasonKind::unlisted_misfit, unknown_words(budget) + cheaper_words(budget)}};
}

/// The best mechanism leaves more than the terms do: what was said of it is taken back. What concerns the data stays.
void claim_terms_only(diagnosis::Diagnosis& d) {
  withdraw_causes(d);
  std::erase_if(d.explanation.reasons, [](const diagnosis::Reason& reason) {
    return reason.kind != ReasonKind::terms_discovered && reason.kind != ReasonKind::anisotropy_seen &&
           reason.kind != ReasonKind::gross_rows;
  });
}

bool only_mechanisms(const Mixture& mixture) {
  return std::all_of(mixture.members.begin(), mixture.members.end(),
                     [](const Member& member) { return member.mechanism.has_value(); });
}

void propose_state(Budget& budget, const diagnosis::Analysis& analysis, const plugins::Catalogue& catalogue) {
  const Contender& lead = *budget.lead;
  if (lead.id != "another_state") return;
  const MisfitSize size(analysis.evidence);
  auto state = proposed_state(analysis.evidence, size, lead.place.tests.front(), lead.share, catalogue);
  if (!state) return;
  // The state is what takes the misfit, in place of mechanisms that would take a part of it.
  Step step;
  step.id = lead.id;
  step.place = lead.place;
  step.group = lead.group;
  step.share = step.shapley = state->share;
  step.rest = size.of(state->fit);
  budget.steps = {std::move(step)};
  budget.fitted.reset();
  budget.rest_channels = size.channels(state->fit);
  budget.adequate = budget.rest().upper <= budget.tolerance.share;
  budget.state = std::make_shared<const ProposedState>(std::move(*state));
}

/// "mu is 31.2 kPa there instead of 20.1", with as many digits as tell the values apart.
std::string change_words(const ProposedState::Change& change) {
  constexpr int least = 3, most = 15;
  std::string there, elsewhere;
  for (int digits = least; digits <= most && there == elsewhere; ++digits) {
    there = fmt::format("{:.{}g}", change.in_state, digits);
    elsewhere = fmt::format("{:.{}g}", change.value, digits);
  }
  return fmt::format("{} is {}{} there instead of {}", change.parameter, there, text::unit_suffix(change.unit),
                     elsewhere);
}

/// "; as a state of its own, mu is 31.2 kPa there instead of 20.1, which takes 97 %". Where all parameters are free
/// there, some hardly differ.
std::string state_words(const Budget& budget) {
  if (!budget.state) return {};
  constexpr double hardly = 1e-3;
  std::vector<std::string> changes, same;
  for (const ProposedState::Change& one : budget.state->changes) {
    if (std::abs(one.in_state - one.value) > hardly * std::abs(one.value))
      changes.push_back(change_words(one));
    else
      same.push_back(one.parameter);
  }
  if (changes.empty()) return {};
  const std::string rest = same.empty() ? ""
                                        : fmt::format(" ({} {} the same to 0.1 %)", text::joined(same),
                                                      text::agreeing(same.size(), "is", "are"));
  return fmt::format("; as a state of its own, {}{}, which takes {}", fmt::join(changes, ", "), rest,
                     percent(budget.state->share));
}

diagnosis::Diagnosis judged(Budget& budget, const experiment::Experiment& experiment,
                            const plugins::Catalogue& catalogue, diagnosis::Diagnosis d) {
  if (budget.contenders.empty()) return d;
  Decision decision = decided(budget);
  Explanation& explanation = d.explanation;
  double most = decision.first.empty() ? budget.contenders.front().share : 0;
  for (const Contender* one : decision.first) most = std::max(most, one->share);
  if (budget.of_file.worth >= std::max(most_of_it, most)) {
    ask_of_the_file(budget, d);
    return d;
  }
  if (decision.verdict == Verdict::unknown) {
    if (explanation.verdict == Verdict::discovered) return d;
    explanation.reasons = {{ReasonKind::unlisted_misfit, unknown_words(budget) + cheaper_words(budget)}};
    add_anisotropy(budget, explanation);
    // Nothing is claimed of causes, so there is no extension to run.
    using diagnosis::WarningKind;
    withdraw_causes(d);
    explanation.left_out.clear();
    std::erase_if(d.prospects.warnings, [](const diagnosis::Warning& warning) {
      return warning.kind == WarningKind::run_keeps_gross_rows || warning.kind == WarningKind::run_differs_in_noise;
    });
    return d;
  }
  const experiment::Experiment measured = experiment::measured_only(experiment);
  const diagnosis::Progress quiet;
  const diagnosis::Inquiry inquiry{measured, d.request, catalogue, quiet};
  std::vector<std::string> unseen;
  if (const Contender& first = *decision.first.front();  // a mistake of the file leads without being a mechanism
      decision.verdict == Verdict::leading && catalogue.mechanisms().contains(first.id))
    unseen = diagnosis::unseen_rivals(inquiry, d.analysis, first.id, first.place);
  if (!unseen.empty()) decision.verdict = Verdict::indistinguishable;
  explanation.verdict = decision.verdict;
  withdraw_causes(d);
  if (decision.verdict == Verdict::leading) {
    budget.lead = *decision.first.front();
    propose_state(budget, d.analysis, catalogue);
    explanation.reasons = {
        {ReasonKind::leads, leading_words(budget, decision, explanation.admissibility.stable.value_or(true)) +
                                doubt_words(budget) + state_words(budget) + cheaper_words(budget)}};
    if (budget.fitted && only_mechanisms(*budget.fitted)) {
      claim(inquiry, d.analysis, budget, *budget.fitted, explanation);
      d.prospects.gain = diagnosis::gain_of(inquiry, d.analysis, explanation.claim);
    }
    add_anisotropy(budget, explanation);
    const Contender& first = *decision.first.front();
    if (!first.term && first.belief == Belief::plausible)
      if (const std::string how = isolated_by(first.id, catalogue); !how.empty())
        d.prospects.next =
            diagnosis::NextExperiment{fmt::format("To confirm {}: {}.", first.id, how), {}, std::nullopt};
    return d;
  }
  const std::vector<const Contender*> ties = tied(decision.first);
  explanation.reasons = {
      {ReasonKind::several_lead, tie_words(budget, ties) + doubt_words(budget) + cheaper_words(budget)}};
  if (!unseen.empty()) explanation.reasons.push_back(diagnosis::not_looked_for(unseen));
  add_anisotropy(budget, explanation);
  claim_tie(ties, unseen, explanation.claim);
  if (const std::vector<std::string> how = switches(ties, catalogue); !how.empty())
    d.prospects.next = diagnosis::NextExperiment{
        fmt::format("To tell them apart, a test that switches one of them alone: {}.", fmt::join(how, "; ")),
        explanation.claim.ambiguity_set, std::nullopt};
  return d;
}

}  // namespace

diagnosis::Diagnosis with_verdict_of(Budget& budget, const experiment::Experiment& experiment,
                                     const plugins::Catalogue& catalogue, diagnosis::Diagnosis diagnosis) {
  diagnosis = judged(budget, experiment, catalogue, std::move(diagnosis));
  if (diagnosis.explanation.verdict == Verdict::discovered) claim_terms_only(diagnosis);
  if (std::string first = next_step(budget, diagnosis.explanation); !first.empty()) {
    auto& next = diagnosis.prospects.next;
    if (!next) next.emplace();
    next->description = next->description.empty() ? first : first + ' ' + text::capitalised(next->description);
  }
  return diagnosis;
}

}  // namespace tunica::budget
