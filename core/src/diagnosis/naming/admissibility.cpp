// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/admissibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include "comparison/stability_report.hpp"
#include "diagnosis/hypotheses/amplitude_range.hpp"
#include "diagnosis/naming/causes.hpp"
#include "diagnosis/naming/credible.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double as_good = 6;  ///< of |r|², and of 2 ln w

Admissibility admissibility_at(const assembly::Assembly& assembly, std::span<const double> free) {
  Admissibility found;
  std::vector<std::string> lost;  // what and where
  bool all = true;
  for (std::size_t m = 0; m < assembly.models().count(); ++m) {
    const auto verdict = stability::judge_admissibility(
        assembly.models().model(m), assembly.models().parameters(m, free), comparison::domain_of(assembly, m));
    const auto transverse = verdict.transversely_stable();
    // A material that changes its volume is judged over unmeasured states. The result is therefore reported, but not
    // weighed.
    const bool elliptic = verdict.changes_volume() || !verdict.ellipticity.first_lost;
    if (transverse == false)
      for (const auto& strip : verdict.transverse) {
        if (strip.stable != false) continue;
        lost.push_back(fmt::format(
            "transverse stability of the {} strip {}", strip.axis == 0 ? "circumferential" : "axial",
            strip.first_unstable ? fmt::format("from stretch {:.4g}", *strip.first_unstable) : "under compression"));
      }
    if (!elliptic)
      lost.push_back(fmt::format("ellipticity in {} from stretch {:.4g}", verdict.ellipticity.path,
                                 *verdict.ellipticity.first_lost));
    if (transverse == false || !elliptic)
      found.stable = false;
    else
      all = all && transverse.has_value();
    for (auto& sentence : verdict.sentences()) found.sentences.push_back(std::move(sentence));
  }
  if (!found.stable && all) found.stable = true;
  found.where = fmt::format("{}", fmt::join(lost, "; "));
  return found;
}

/// A mechanism of the material, at its first place.
struct Trial {
  std::size_t candidate, direction;
  std::optional<Refit> refit = {};
  bool stable = false;
  double log_weight = 0;

  [[nodiscard]] double chi2() const { return refit->fit.chi2; }
};

std::vector<Trial> trials_of(const Hypotheses& hypotheses) {
  std::vector<Trial> trials;
  for (std::size_t c = 0; c < hypotheses.candidates.size(); ++c) {
    if (hypotheses.candidates[c].mechanism->stage > Stage::energy) continue;  // errors of the rig make nothing stable
    const auto first = std::find_if(hypotheses.directions.begin(), hypotheses.directions.end(),
                                    [c](const Direction& direction) { return direction.candidate == c; });
    if (first != hypotheses.directions.end())
      trials.push_back({c, static_cast<std::size_t>(first - hypotheses.directions.begin())});
  }
  return trials;
}

/// From what the score says and from a large amplitude: the better refit, a stable one before any other.
Trial fitted(const Inquiry& inquiry, const Analysis& analysis, Trial trial) {
  const Direction& direction = analysis.hypotheses.directions[trial.direction];
  const MechanismFactory& mechanism = *analysis.hypotheses.candidates[trial.candidate].mechanism;
  const AmplitudeRange range = range_of(mechanism, analysis.hypotheses.hypothesis(direction).addition);
  const double side =
      (range.plausible_max > mechanism.null ? range.plausible_max : range.plausible_min) - mechanism.null;
  for (const double amplitude : {score(direction, -analysis.evidence.fit.residuals).amplitude, 0.3 * side}) {
    auto refit =
        fit_with(inquiry, analysis, {analysis.hypotheses.hypothesis(direction).addition}, std::array{amplitude});
    if (!refit) continue;
    const bool stable = admissibility_at(refit->extension->assembly(), refit->fit.free).stable == true;
    const bool better =
        !trial.refit || (stable && !trial.stable) || (stable == trial.stable && refit->fit.chi2 < trial.chi2());
    if (!better) continue;
    trial.refit = std::move(refit);
    trial.stable = stable;
  }
  return trial;
}

/// Those that restore stability and fit as well as the base.
std::vector<Trial> restoring_trials(const Inquiry& inquiry, const Analysis& analysis) {
  std::vector<Trial> trials = trials_of(analysis.hypotheses);
  tbb::parallel_for(std::size_t{0}, trials.size(),
                    [&](std::size_t t) { trials[t] = fitted(inquiry, analysis, std::move(trials[t])); });
  const double most = analysis.evidence.fit.chi2 + as_good;
  std::erase_if(trials, [most](const Trial& trial) { return !trial.refit || !trial.stable || trial.chi2() > most; });
  return trials;
}

/// Of equally probable extensions those that are about as likely as the first.
Claim claim_of(const Inquiry& inquiry, const Analysis& analysis, const std::vector<Trial>& trials) {
  std::vector<double> logs;
  for (const Trial& trial : trials) logs.push_back(trial.log_weight);
  const double all = log_sum(logs);
  Claim claim;
  claim.named = 1;
  claim.best = trials.front().refit;
  for (const Trial& trial : trials) {
    if (2 * (trials.front().log_weight - trial.log_weight) > as_good) continue;
    Cause cause = cause_of(inquiry, analysis, *trial.refit, 0, analysis.hypotheses.directions[trial.direction]);
    cause.p_value = analysis.alarm.detection.by_candidate[trial.candidate];
    cause.probability = std::exp(trial.log_weight - all);
    claim.ambiguity_set.push_back(cause.id);
    claim.rivals.push_back(*trial.refit);
    claim.causes.push_back(std::move(cause));
  }
  return claim;
}

}  // namespace

Admissibility admissibility_of(const Evidence& evidence) { return admissibility_at(*evidence.base, evidence.fit.free); }

Explanation stabilised(const Inquiry& inquiry, const Analysis& analysis, const Admissibility& admissibility) {
  const std::vector<Candidate>& candidates = analysis.hypotheses.candidates;
  const double base = analysis.evidence.fit.chi2;
  const std::string lost = "the base fit loses " + admissibility.where;
  std::vector<Trial> trials = restoring_trials(inquiry, analysis);
  Explanation found;
  if (trials.empty()) {
    found.verdict = Verdict::unknown;
    found.reasons.push_back({ReasonKind::lost_stability,
                             lost + ", and no mechanism of the catalogue gives an admissible fit that is as good"});
    return found;
  }
  // The smallest extension: the one with the fewest parameters among those that restore stability. The fault is the
  // lost stability, and a further parameter that only improves the fit is no evidence about it.
  const auto size = [&](const Trial& trial) { return candidates[trial.candidate].mechanism->parameters.size(); };
  std::size_t fewest = size(trials.front());
  for (const Trial& trial : trials) fewest = std::min(fewest, size(trial));
  std::vector<std::string> larger;
  for (const Trial& trial : trials)
    if (size(trial) > fewest) larger.push_back(candidates[trial.candidate].id);
  std::erase_if(trials, [&](const Trial& trial) { return size(trial) > fewest; });
  for (Trial& trial : trials)
    trial.log_weight = (base - trial.chi2()) / 2 + log_prior(analysis.hypotheses.directions[trial.direction]);
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.log_weight > b.log_weight; });

  found.claim = claim_of(inquiry, analysis, trials);
  const std::size_t count = found.claim.causes.size();
  found.verdict = count == 1                   ? Verdict::named
                  : count <= most_explanations ? Verdict::indistinguishable
                                               : Verdict::unknown;
  const std::string& first = found.claim.causes.front().id;
  found.reasons.push_back(
      {ReasonKind::stability_restored, fmt::format("{}; with {} the fit is as good and admissible", lost, first)});
  if (!larger.empty())
    found.reasons.push_back(
        {ReasonKind::restored_by_larger, fmt::format("{} {} so too, with more parameters", fmt::join(larger, ", "),
                                                     larger.size() == 1 ? "does" : "do")});
  found.admissibility.remedy = first;
  return found;
}

}  // namespace tunica::diagnosis
