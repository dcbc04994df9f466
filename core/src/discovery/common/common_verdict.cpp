// SPDX-License-Identifier: Apache-2.0
#include "discovery/common/common_verdict.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/naming/remainder.hpp"
#include "discovery/remainder.hpp"
#include "discovery/verdict.hpp"
#include "text/lists.hpp"

namespace tunica::discovery {
namespace {

using diagnosis::Verdict;

std::set<std::string> invariants_of(const CommonFit& fit) {
  std::set<std::string> words;
  for (const KindPointer& kind : fit.kinds) words.insert(kind->invariant_words());
  return words;
}

/// That of the specimens in which history decides, where these are the most.
PathDependence common_paths(const std::vector<PathDependence>& of_specimens) {
  std::vector<PathDependence> deciding;
  for (const PathDependence& one : of_specimens)
    if (one.decides()) deciding.push_back(one);
  if (2 * deciding.size() <= of_specimens.size()) return {};
  std::sort(deciding.begin(), deciding.end(),
            [](const PathDependence& a, const PathDependence& b) { return a.share < b.share; });
  PathDependence middle = deciding[deciding.size() / 2];
  middle.where += fmt::format(" (so in {} of {} specimens)", deciding.size(), of_specimens.size());
  return middle;
}

std::vector<std::size_t> all_but(std::size_t without, std::size_t count) {
  std::vector<std::size_t> others;
  for (std::size_t s = 0; s < count; ++s)
    if (s != without) others.push_back(s);
  return others;
}

/// Whether a single specimen is all that asks for these terms: they are no property of the tissue.
bool rests_on_one(const CommonFitter& fitter, const CommonFit& set) {
  const std::size_t count = set.specimens.size();
  for (std::size_t s = 0; s < count && count > 2; ++s) {
    const std::vector<std::size_t> others = all_but(s, count);
    if (fitter.log_evidence(set, others) < fitter.log_evidence(fitter.root(), others)) return true;
  }
  return false;
}

/// Whether the others choose the invariants of the best set without this specimen.
bool agree_without(const CommonFitter& fitter, const std::vector<CommonFit>& sets, std::size_t without) {
  const std::vector<std::size_t> others = all_but(without, sets.front().specimens.size());
  const auto best = std::max_element(sets.begin(), sets.end(), [&](const CommonFit& a, const CommonFit& b) {
    return fitter.log_evidence(a, others) < fitter.log_evidence(b, others);
  });
  return invariants_of(*best) == invariants_of(sets.front());
}

/// The terms of the best set with what each specimen says of them.
std::vector<CommonTerm> common_terms(const CommonDiscovery& found) {
  std::vector<std::vector<FoundTerm>> own;
  for (std::size_t s = 0; s < found.specimens.size(); ++s) {
    const SetFit& fit = found.best->specimens[s];
    own.push_back(fit.set ? terms_of(fit, found.judgement) : std::vector<FoundTerm>{});
    for (std::size_t k = 0; k < own[s].size(); ++k)
      own[s][k].curve = curve_of_term(*found.specimens[s].subject, fit, k);
  }
  std::vector<CommonTerm> terms;
  for (std::size_t k = 0; k < found.best->kinds.size(); ++k) {
    const KindPointer& kind = found.best->kinds[k];
    const auto same = [&](const CommonTerm& term) { return term.kind->name == kind->name; };
    const auto copy = static_cast<std::size_t>(std::count_if(terms.begin(), terms.end(), same));
    CommonTerm term{copy == 0 ? kind->name : fmt::format("{}_{}", kind->name, copy + 1),
                    kind,
                    probability_of(found.judgement, *kind),
                    probability_of_invariant(found.judgement, *kind),
                    {}};
    for (const std::vector<FoundTerm>& of_specimen : own) {
      std::size_t before = copy;
      std::optional<FoundTerm> match;
      for (const FoundTerm& one : of_specimen)
        if (!match && one.kind->name == kind->name && before-- == 0) match = one;
      term.specimens.push_back(std::move(match));
    }
    terms.push_back(std::move(term));
  }
  return terms;
}

std::string listed(const std::vector<std::string>& ids) {
  constexpr std::size_t most = 6;
  if (ids.size() <= most) return fmt::format("{}", fmt::join(ids, ", "));
  return fmt::format("{} and {} more", fmt::join(ids.begin(), ids.begin() + most, ", "), ids.size() - most);
}

/// How far the specimens agree, a sentence each.
void say_who_agrees(CommonDiscovery& found) {
  auto& reasons = found.judgement.reasons;
  const std::size_t n = found.specimens.size();
  std::vector<std::string> seen, needed, left;
  for (const CommonTerm& term : found.terms)
    seen.push_back(fmt::format("{} shows in {} of {} specimens", words_of({term.kind}), term.seen(), n));
  for (const SpecimenOutcome& one : found.specimens) {
    if (one.needed) needed.push_back(one.id);
    if (!diagnosis::is_clean(one.p_after)) left.push_back(one.id);
  }
  if (n > 1)
    reasons.push_back(
        {ReasonKind::specimens_agree,
         fmt::format("{}. {}.", fmt::join(seen, "; "),
                     needed.empty() ? "Whichever specimen is left out, the others choose the same invariants"
                                    : "The others choose other invariants without " + listed(needed))});
  if (!left.empty() && n > 1)
    reasons.push_back({ReasonKind::specimens_left_over, fmt::format("What is left is not noise in {}.", listed(left))});
}

}  // namespace

void settle(CommonDiscovery& found, const CommonFitter& fitter, std::vector<CommonFit> sets) {
  const std::size_t searched = sets.size();
  std::erase_if(sets, [&](const CommonFit& set) { return rests_on_one(fitter, set); });
  Findings findings{found.request.from_nothing, {}, found.rivals};
  findings.specimens = found.specimens.size();
  for (const CommonFit& set : sets) findings.sets.push_back({set.kinds, set.log_evidence, set.chi2()});
  if (!sets.empty()) {
    found.best = sets.front();
    found.chi2_after = found.best->chi2();
  }
  std::vector<PathDependence> paths;
  std::vector<double> p_values;
  for (std::size_t s = 0; s < found.specimens.size(); ++s) {
    SpecimenOutcome& one = found.specimens[s];
    const diagnosis::Evidence& evidence = one.analysis.evidence;
    const diagnosis::Fit& fit = found.best ? found.best->specimens[s].fit : evidence.fit;
    one.chi2_after = fit.chi2;
    one.p_after = p_of_rest(one.analysis, fit);
    if (found.best) {
      one.gain = data_evidence(found.best->specimens[s], found.request.from_nothing) -
                 data_evidence(fitter.root().specimens[s], found.request.from_nothing);
      one.needed = !agree_without(fitter, sets, s);
    }
    p_values.push_back(one.p_after);
    paths.push_back(path_dependence(evidence, fit));
  }
  found.p_after = p_of_rests(p_values);
  found.paths = common_paths(paths);
  findings.paths = found.paths;
  findings.rows = static_cast<double>(found.rows);
  findings.chi2_before = found.chi2_before;
  findings.chi2_after = found.chi2_after;
  findings.p_after = found.p_after;
  found.judgement = judge(findings);
  for (Reason& reason : found.judgement.reasons)
    if (reason.kind == ReasonKind::no_term && searched > 0)
      reason.text = "Terms of the energy help in single specimens only, and so are no property of the tissue.";
    else if (reason.kind == ReasonKind::no_term && found.specimens.size() > 1)
      reason.text = "No term of the energy makes the fit better in half of the specimens or more.";
  if (!found.judgement.offers_terms) return;
  found.terms = common_terms(found);
  say_who_agrees(found);
}

void say_nothing_is_missing(CommonDiscovery& found) {
  found.judgement.verdict = Verdict::nothing_detected;
  found.judgement.reasons.push_back(
      {ReasonKind::residuals_like_noise,
       fmt::format("The residuals of {} could be noise (p = {:.2g}); there is nothing to discover.",
                   text::counted(found.specimens.size(), "specimen", "specimens"), found.p_before)});
}

}  // namespace tunica::discovery
