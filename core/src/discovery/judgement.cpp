// SPDX-License-Identifier: Apache-2.0
#include "discovery/judgement.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/naming/credible.hpp"
#include "diagnosis/naming/remainder.hpp"
#include "diagnosis/naming/singles.hpp"

namespace tunica::discovery {
namespace {

using diagnosis::Verdict;

constexpr double clear_of_rig = 0.25;  ///< probability of the rig above which nothing is said to be discovered
constexpr double one_invariant = 0.75;
constexpr double worth_a_name = 3;  ///< of the evidence of a specimen, by which a mechanism has to be ahead of terms

std::set<std::string> invariants_of(const std::vector<KindPointer>& kinds) {
  std::set<std::string> words;
  for (const KindPointer& kind : kinds) words.insert(kind->invariant_words());
  return words;
}

/// All explanations with their probabilities, likeliest first; there is a set at least.
std::vector<Alternative> weighed(const Findings& found) {
  std::vector<Alternative> all;
  std::vector<double> logs;
  for (const WeighedSet& set : found.sets) {
    all.push_back({set.kinds, {}, false, 0, set.chi2});
    logs.push_back(set.log_evidence);
  }
  for (const Rival& rival : found.rivals) {
    if (rival.in_the_energy || !rival.plausible) continue;
    all.push_back({{}, rival.id, rival.remembers, 0, rival.chi2});
    logs.push_back(rival.log_evidence);
  }
  const double sum = diagnosis::log_sum(logs);
  for (std::size_t k = 0; k < all.size(); ++k) all[k].probability = std::exp(logs[k] - sum);
  // The set that was chosen stays ahead of those that are as likely.
  std::stable_sort(all.begin() + 1, all.end(),
                   [](const Alternative& a, const Alternative& b) { return a.probability > b.probability; });
  return all;
}

std::vector<Alternative> credible(const std::vector<Alternative>& all) {
  constexpr std::size_t most = 40;
  std::vector<Alternative> set;
  double mass = 0;
  for (const Alternative& one : all) {
    if (mass >= diagnosis::set_mass || set.size() == most) break;
    set.push_back(one);
    mass += one.probability;
  }
  return set;
}

/// The evidence of the best explanation by terms or by the rig.
double best_of(const Findings& found) {
  double best = found.sets.front().log_evidence;
  for (const Rival& rival : found.rivals)
    if (!rival.in_the_energy && rival.plausible) best = std::max(best, rival.log_evidence);
  return best;
}

template <class Counts>
double mass_of(const std::vector<Alternative>& all, const Counts& counts) {
  double mass = 0;
  for (const Alternative& one : all)
    if (counts(one)) mass += one.probability;
  return mass;
}

std::string laws_left(const std::vector<Alternative>& ambiguity) {
  std::vector<std::string> words;
  for (const Alternative& one : ambiguity)
    if (words.size() < 4) words.push_back(one.mechanism.empty() ? words_of(one.kinds) : one.mechanism);
  return fmt::format("{}", fmt::join(words, "; "));
}

}  // namespace

const char* code_of(ReasonKind kind) {
  switch (kind) {
    case ReasonKind::residuals_like_noise:
      return "residuals_like_noise";
    case ReasonKind::terms_found:
      return "terms_found";
    case ReasonKind::form_open:
      return "form_open";
    case ReasonKind::invariant_open:
      return "invariant_open";
    case ReasonKind::not_an_energy:
      return "not_an_energy";
    case ReasonKind::rig_explains:
      return "rig_explains";
    case ReasonKind::name_explains:
      return "name_explains";
    case ReasonKind::rig_rival:
      return "rig_rival";
    case ReasonKind::not_clean:
      return "not_clean";
    case ReasonKind::gross_rows:
      return "gross_rows";
    case ReasonKind::specimens_agree:
      return "specimens_agree";
    case ReasonKind::specimens_left_over:
      return "specimens_left_over";
    case ReasonKind::anisotropy_seen:
      return "anisotropy_seen";
    case ReasonKind::leads:
      return "leads";
    case ReasonKind::same_model:
      return "same_model";
    case ReasonKind::searched_cheaper:
      return "searched_cheaper";
    case ReasonKind::no_term:
      break;
  }
  return "no_term";
}

std::string words_of(const std::vector<KindPointer>& kinds) {
  std::vector<std::string> words;
  for (const KindPointer& kind : kinds)
    words.push_back(fmt::format("{} ({})", kind->invariant_words(),
                                kind->law == "spline"            ? "a curve"
                                : kind->invariant == "stretches" ? "power"
                                                                 : kind->law));
  return fmt::format("{}", fmt::join(words, " and "));
}

double probability_of(const Judgement& judgement, const Kind& kind) {
  return mass_of(judgement.all, [&](const Alternative& one) {
    return std::any_of(one.kinds.begin(), one.kinds.end(),
                       [&](const KindPointer& other) { return other->name == kind.name; });
  });
}

double probability_of_invariant(const Judgement& judgement, const Kind& kind) {
  return mass_of(judgement.all, [&](const Alternative& one) {
    return std::any_of(one.kinds.begin(), one.kinds.end(),
                       [&](const KindPointer& other) { return other->invariant_words() == kind.invariant_words(); });
  });
}

std::string lacking_words(const Judgement& judgement, const std::vector<KindPointer>& kinds) {
  std::vector<KindPointer> sure;
  std::vector<std::string> open;
  for (const KindPointer& kind : kinds)
    if (const double p = probability_of_invariant(judgement, *kind); p >= one_invariant)
      sure.push_back(kind);
    else
      open.push_back(fmt::format("{} {:.2f}", words_of({kind}), p));
  if (sure.empty() || open.empty()) return words_of(kinds);
  return fmt::format("{} and {} of which the form is open (likeliest {})", words_of(sure),
                     open.size() == 1 ? "one more term" : fmt::format("{} more terms", open.size()),
                     fmt::join(open, ", "));
}

Judgement judge(const Findings& found) {
  Judgement judgement;
  const auto because = [&](ReasonKind kind, std::string text) { judgement.reasons.push_back({kind, std::move(text)}); };
  for (const Rival& rival : found.rivals)
    if (rival.in_the_energy && rival.plausible && !judgement.name) judgement.name = rival;
  if (found.paths.decides()) {
    because(ReasonKind::not_an_energy,
            fmt::format("The energy is not the place: at the same strain the data differ between {}. That takes {:.0f} "
                        "% of what the best terms leave. An energy has one stress at one strain; look for history, "
                        "rate or an error of the rig.",
                        found.paths.where, 100 * found.paths.share));
    return judgement;
  }
  if (found.sets.empty()) {
    because(ReasonKind::no_term, "No term of the energy makes the fit better.");
    return judgement;
  }
  judgement.all = weighed(found);
  judgement.ambiguity = credible(judgement.all);
  const std::vector<Alternative>& all = judgement.all;
  const std::vector<KindPointer>& best = found.sets.front().kinds;
  const bool clean = diagnosis::is_clean(found.p_after);
  // From nothing, of what a neo-Hookean term leaves.
  const double before = found.chi2_before;
  const double share = std::clamp((before - found.chi2_after) / std::max(before - found.rows, 1.0), 0.0, 1.0);
  const double of_rig = mass_of(all, [](const Alternative& one) { return !one.mechanism.empty(); });
  const std::string words = words_of(best);
  const auto& name = judgement.name;
  if (name && name->clean &&
      name->log_evidence > best_of(found) + worth_a_name * static_cast<double>(found.specimens)) {
    judgement.verdict = Verdict::named;
    because(ReasonKind::name_explains,
            fmt::format("The catalogue has a name for it: {} leaves |r|² {:.1f}, the best terms {:.1f}. `tunica "
                        "diagnose` says more.",
                        name->id, name->chi2, found.chi2_after));
    return judgement;
  }
  if (of_rig > 1 - clear_of_rig) {
    const auto rig =
        std::find_if(all.begin(), all.end(), [](const Alternative& one) { return !one.mechanism.empty(); });
    judgement.verdict = Verdict::named;
    because(ReasonKind::rig_explains,
            fmt::format("{} explains the misfit better than any term of the energy (|r|² {:.1f}, the best terms leave "
                        "{:.1f}). Correct that first.",
                        rig->mechanism, rig->chi2, found.chi2_after));
    return judgement;
  }
  judgement.offers_terms = true;
  if (of_rig > clear_of_rig) {
    judgement.verdict = Verdict::indistinguishable;
    because(ReasonKind::rig_rival,
            fmt::format("An error of the rig or memory explains the misfit about as well as a term of the energy: {}.",
                        laws_left(judgement.ambiguity)));
    return judgement;
  }
  if (!clean) {
    because(ReasonKind::not_clean,
            fmt::format("The best terms, {}, take {:.0f} % of the misfit beyond noise, and the rest is not noise.",
                        words, 100 * share));
    return judgement;
  }
  const std::string taken =
      found.from_nothing
          ? fmt::format("The energy is {}; |r|² is {:.1f} for {:.0f} rows.", lacking_words(judgement, best),
                        found.chi2_after, found.rows)
          : fmt::format("The energy lacks {}; it takes {:.0f} % of the misfit beyond noise, |r|² {:.1f} → {:.1f}.",
                        lacking_words(judgement, best), 100 * share, found.chi2_before, found.chi2_after);
  const auto best_invariants = invariants_of(best);
  const double sure = mass_of(all, [&](const Alternative& one) { return invariants_of(one.kinds) == best_invariants; });
  // Where one invariant is sure and another beside it is open, the first is discovered all the same.
  const bool one_is_sure = std::any_of(best.begin(), best.end(), [&](const KindPointer& kind) {
    return probability_of_invariant(judgement, *kind) >= one_invariant;
  });
  judgement.verdict = one_is_sure ? Verdict::discovered : Verdict::indistinguishable;
  because(ReasonKind::terms_found, taken);
  const std::size_t forms = judgement.ambiguity.size();
  if (sure < one_invariant)
    because(ReasonKind::invariant_open, fmt::format("These data do not tell {} it is a function of: {}.",
                                                    one_is_sure ? "all that" : "what", laws_left(judgement.ambiguity)));
  else if (forms > 1)
    because(ReasonKind::form_open, fmt::format("{} forms are about as likely on these data: {}{}.", forms,
                                               laws_left(judgement.ambiguity), forms > 4 ? "; …" : ""));
  return judgement;
}

}  // namespace tunica::discovery
