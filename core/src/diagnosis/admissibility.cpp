// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/admissibility.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include "comparison/stability_report.hpp"
#include "diagnosis/causes.hpp"
#include "diagnosis/refits.hpp"
#include "diagnosis/singles.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double as_good = 6;  ///< of |r|², and of 2 ln w

struct Found {
  std::optional<bool> stable;
  std::vector<std::string> lost;  ///< what and where
  std::vector<std::string> sentences;
};

Found judge(const assembly::Assembly& assembly, std::span<const double> free) {
  Found found;
  bool all = true;
  for (std::size_t m = 0; m < assembly.models().count(); ++m) {
    const auto verdict = stability::judge_admissibility(
        assembly.models().model(m), assembly.models().parameters(m, free), comparison::domain_of(assembly, m));
    const auto transverse = verdict.transversely_stable();
    const bool elliptic = !verdict.ellipticity.first_lost;
    if (transverse == false)
      for (const auto& strip : verdict.transverse)
        if (strip.stable == false)
          found.lost.push_back(strip.first_unstable
                                   ? fmt::format("transverse stability of the {} strip from stretch {:.4g}",
                                                 strip.axis == 0 ? "circumferential" : "axial", *strip.first_unstable)
                                   : fmt::format("transverse stability of the {} strip under compression",
                                                 strip.axis == 0 ? "circumferential" : "axial"));
    if (!elliptic)
      found.lost.push_back(fmt::format("ellipticity in {} from stretch {:.4g}", verdict.ellipticity.path,
                                       *verdict.ellipticity.first_lost));
    if (transverse == false || !elliptic)
      found.stable = false;
    else
      all = all && transverse.has_value();
    for (auto& sentence : verdict.sentences()) found.sentences.push_back(std::move(sentence));
  }
  if (!found.stable && all) found.stable = true;
  return found;
}

}  // namespace

void judge_admissibility(Diagnosis& d) {
  Found found = judge(*d.base, d.fit.free);
  d.admissibility.stable = found.stable;
  d.admissibility.where = fmt::format("{}", fmt::join(found.lost, "; "));
  d.admissibility.sentences = std::move(found.sentences);
}

void name_admissible_extension(Diagnosis& d, const plugins::Catalogue& catalogue) {
  struct Trial {
    std::size_t candidate, direction;
    std::optional<Refitted> refitted = {};
    double chi2 = INFINITY, log_weight = 0;
    bool stable = false;
  };
  std::vector<Trial> trials;
  for (std::size_t c = 0; c < d.candidates.size(); ++c) {
    if (d.candidates[c].mechanism->stage > Stage::energy) continue;  // errors of the rig make no material stable
    for (std::size_t k = 0; k < d.directions.size(); ++k)
      if (d.directions[k].candidate == c) {
        trials.push_back({c, k});
        break;
      }
  }
  tbb::parallel_for(std::size_t{0}, trials.size(), [&](std::size_t t) {
    const Direction& direction = d.directions[trials[t].direction];
    const MechanismFactory& mechanism = *d.candidates[trials[t].candidate].mechanism;
    const double side = mechanism.plausible_max > mechanism.null ? mechanism.plausible_max - mechanism.null
                                                                 : mechanism.plausible_min - mechanism.null;
    for (const double amplitude : {score(direction, -d.fit.residuals).amplitude, 0.3 * side}) {
      auto refitted = fit_with(d, {d.candidates[trials[t].candidate].hypotheses[direction.hypothesis].addition},
                               std::array{amplitude}, catalogue);
      if (!refitted) continue;
      const bool stable = judge(refitted->extended->assembly(), refitted->fit.free).stable == true;
      if (!trials[t].refitted || (stable && !trials[t].stable) ||
          (stable == trials[t].stable && refitted->fit.chi2 < trials[t].chi2))
        trials[t].chi2 = refitted->fit.chi2, trials[t].refitted = std::move(refitted), trials[t].stable = stable;
    }
  });
  std::erase_if(trials, [&](const Trial& trial) {
    return !trial.refitted || !trial.stable || trial.chi2 > d.fit.chi2 + as_good;
  });
  // The least extension: of those that mend it the ones with the fewest parameters, for the misfit is the lost
  // stability, and what a further parameter does for the fit says nothing about that.
  std::vector<std::string> larger;
  const auto size = [&](const Trial& trial) { return d.candidates[trial.candidate].mechanism->parameters.size(); };
  const auto least =
      std::min_element(trials.begin(), trials.end(), [&](const Trial& a, const Trial& b) { return size(a) < size(b); });
  const std::size_t fewest = least == trials.end() ? 0 : size(*least);
  std::erase_if(trials, [&](const Trial& trial) {
    if (size(trial) > fewest) larger.push_back(d.candidates[trial.candidate].id);
    return size(trial) > fewest;
  });
  for (Trial& trial : trials) trial.log_weight = (d.fit.chi2 - trial.chi2) / 2 + log_prior(d, trial.direction);
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.log_weight > b.log_weight; });
  const std::string lost = "the base fit loses " + d.admissibility.where;
  if (trials.empty()) {
    d.verdict = Verdict::unknown;
    d.reasons.push_back(lost + ", and no mechanism of the catalogue gives an admissible fit that is as good");
    return;
  }
  std::vector<double> logs;
  for (const Trial& trial : trials) logs.push_back(trial.log_weight);
  const double all = log_sum(logs);
  for (const Trial& trial : trials) {
    if (2 * (trials.front().log_weight - trial.log_weight) > as_good) continue;
    Cause cause = cause_of(d, *trial.refitted, 0, d.directions[trial.direction], catalogue);
    cause.p_value = d.detection.by_candidate[trial.candidate];
    cause.probability = std::exp(trial.log_weight - all);
    d.ambiguity_set.push_back(cause.id), d.rivals.push_back(*trial.refitted);
    d.causes.push_back(std::move(cause));
  }
  d.named = 1;
  d.extension = trials.front().refitted;
  d.verdict = d.causes.size() == 1   ? Verdict::named
              : d.causes.size() <= 4 ? Verdict::indistinguishable
                                     : Verdict::unknown;
  d.reasons.push_back(fmt::format("{}; with {} the fit is as good and admissible", lost, d.causes.front().id));
  if (!larger.empty())
    d.reasons.push_back(fmt::format("so it is, with more parameters, with {}", fmt::join(larger, ", ")));
  d.admissibility.remedy = d.causes.front().id;
}

}  // namespace tunica::diagnosis
