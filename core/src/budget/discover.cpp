// SPDX-License-Identifier: Apache-2.0
#include "budget/discover.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "budget/output/outputs.hpp"
#include "budget/same_model.hpp"

namespace tunica::budget {
namespace {

using diagnosis::Verdict;
using discovery::Alternative;
using discovery::Discovery;

constexpr double as_much_as_terms = 0.15;  ///< of the misfit
constexpr double nearly_all = 0.9;         ///< of the misfit
constexpr double sure_invariant = 0.9;     ///< of an invariant, with what is left as the noise

std::set<std::string> invariants_of(const Alternative& one) {
  std::set<std::string> words;
  for (const discovery::KindPointer& kind : one.kinds) words.insert(kind->invariant_words());
  return words;
}

/// The invariants that are sure where the noise is as large as what the best terms leave, s² = |r|²/n: the weight of a
/// set with k parameters is
///
///   exp(−|r|²/2s²) n^(−k/2).
std::vector<std::string> sure_invariants(const Discovery& found, double rows) {
  const double variance = std::max(found.chi2_after / rows, 1.0);
  double sum = 0;
  std::map<std::string, double> mass;
  for (const Alternative& one : found.judgement.all) {
    double parameters = 0;
    for (const discovery::KindPointer& kind : one.kinds)
      parameters += 1 + static_cast<double>(kind->heights.size() + kind->shapes.size());
    const double weight = std::exp(-0.5 * (one.chi2 - found.chi2_after) / variance - 0.5 * parameters * std::log(rows));
    sum += weight;
    for (const std::string& words : invariants_of(one)) mass[words] += weight;
  }
  std::vector<std::string> sure;
  for (const auto& [words, weight] : mass)
    if (weight >= sure_invariant * sum) sure.push_back(words);
  return sure;
}

/// The verdict of terms that take most and leave more than noise; none where no invariant is sure, or where what makes
/// up the whole energy misses by far more than is tolerated.
std::string leading_words(const Discovery& found) {
  const diagnosis::Evidence& evidence = found.analysis.evidence;
  const MisfitSize size(evidence);
  const Tolerance tolerance = tolerance_of(discovery::analysis_request(found.request), evidence);
  const double before = size.squares(evidence.fit), after = size.squares(found.best->fit);
  const Size rest = size.of(found.best->fit);
  const double share = 1 - after / std::max(before, 1e-300);
  constexpr double nearly = 1.5;
  // What is within the tolerance needs no term, and an error of the rig or memory that takes about as much is a rival.
  if (size.of(evidence.fit).rms <= tolerance.share && !found.request.from_nothing) return "";
  for (const discovery::Rival& rival : found.rivals) {
    if (!rival.in_the_energy && rival.plausible &&
        1 - size.squares(rival.chi2, evidence.fit) / std::max(before, 1e-300) > share - as_much_as_terms)
      return "";
  }
  if (share < nearly_all || (found.request.from_nothing && rest.rms > nearly * tolerance.share)) return "";
  const auto sure = sure_invariants(found, static_cast<double>(evidence.fit.residuals.size()));
  if (sure.empty()) return "";
  const std::string words = discovery::words_of(found.best->kinds);
  return fmt::format("{} functions of {}: {} take {} of the misfit{}; {}.",
                     found.request.from_nothing ? "The energy is made of" : "The energy mainly lacks",
                     fmt::join(sure, " and "), words, percent(share),
                     found.request.from_nothing ? " of a neo-Hookean term" : "", remains(rest, tolerance));
}

}  // namespace

Discovery discover(const experiment::Experiment& experiment, const discovery::Request& request,
                   const plugins::Catalogue& catalogue, const diagnosis::Progress& progress) {
  Discovery found = discovery::discover(experiment, request, catalogue, progress);
  discovery::Judgement& judgement = found.judgement;
  if (!found.best || !found.best->set || !judgement.offers_terms) return found;
  if (judgement.verdict == Verdict::unknown && judgement.reasons.front().kind == discovery::ReasonKind::not_clean)
    if (std::string words = leading_words(found); !words.empty()) {
      judgement.verdict = Verdict::leading;
      judgement.reasons.front() = {discovery::ReasonKind::leads, std::move(words)};
    }
  const std::string model = found.request.from_nothing ? std::string()
                                                       : same_model(*found.subject, found.analysis.evidence,
                                                                    found.best->set->assembly(), found.best->fit, {});
  if (!model.empty())
    judgement.reasons.push_back({discovery::ReasonKind::same_model,
                                 fmt::format("With these terms it is the model `{}` on these data.", model)});
  return found;
}

}  // namespace tunica::budget
