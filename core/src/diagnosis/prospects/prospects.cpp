// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/prospects/prospects.hpp"

#include <set>

#include <fmt/format.h>

#include "assembly/memory.hpp"
#include "diagnosis/evidence/large_noise.hpp"
#include "diagnosis/evidence/vanishing_noise.hpp"
#include "diagnosis/prospects/detectable.hpp"
#include "diagnosis/prospects/extended_run.hpp"
#include "diagnosis/prospects/gain.hpp"
#include "diagnosis/prospects/next_experiment.hpp"
#include "text/lists.hpp"

namespace tunica::diagnosis {
namespace {

std::vector<Warning> noise_warnings(const Evidence& evidence, const Explanation& explanation) {
  std::vector<Warning> warnings;
  const std::optional<Refit>& best = explanation.claim.best;
  if (auto warning = large_noise_warning(evidence, best ? best->fit : evidence.fit)) warnings.push_back(*warning);
  if (explanation.verdict == Verdict::nothing_detected) return warnings;
  if (auto warning = vanishing_noise_warning(evidence)) warnings.push_back(*warning);
  return warnings;
}

/// "signal_drift was not looked for in these tests, stress_softening only as in a first loading".
std::string not_looked_for_words(const std::vector<std::string>& nowhere, const std::vector<std::string>& elsewhere,
                                 const std::vector<std::string>& first_loading) {
  const auto were = [](const std::vector<std::string>& ids) { return text::agreeing(ids.size(), "was", "were"); };
  std::string words;
  if (!nowhere.empty()) words = fmt::format("{} {} not looked for", text::joined(nowhere), were(nowhere));
  if (!elsewhere.empty())
    words += nowhere.empty()
                 ? fmt::format("{} {} not looked for in these tests", text::joined(elsewhere), were(elsewhere))
                 : fmt::format(", nor {} in these tests", text::joined(elsewhere));
  if (first_loading.empty()) return words;
  if (words.empty())
    return fmt::format("{} {} looked for in these tests only as in a first loading", text::joined(first_loading),
                       were(first_loading));
  return fmt::format("{}; {} only as in a first loading", words, text::joined(first_loading));
}

/// One sentence for whatever has memory and all tests whose past is unknown: what to record.
std::optional<Warning> memory_warning(const Inquiry& inquiry, const Analysis& analysis) {
  std::vector<std::string> nowhere, elsewhere, first_loading;
  std::set<std::string> tests;
  for (const Candidate& candidate : analysis.hypotheses.candidates) {
    if (candidate.without_past.empty()) continue;
    const bool of_material = candidate.mechanism->stage < Stage::test;
    (candidate.hypotheses.empty() ? nowhere : of_material ? first_loading : elsewhere).push_back(candidate.id);
    tests.insert(candidate.without_past.begin(), candidate.without_past.end());
  }
  if (tests.empty()) return std::nullopt;
  const Evidence& evidence = analysis.evidence;
  std::vector<assembly::TestPast> pasts = assembly::unknown_pasts(evidence.experiment, evidence.run, inquiry.catalogue);
  std::erase_if(pasts, [&](const assembly::TestPast& one) { return !tests.contains(one.test); });
  return Warning{
      WarningKind::memory_not_looked_for,
      fmt::format("{}: {}", not_looked_for_words(nowhere, elsewhere, first_loading), assembly::words_of(pasts))};
}

}  // namespace

Prospects prospects_of(const Inquiry& inquiry, const Analysis& analysis, const Explanation& explanation) {
  Prospects prospects;
  if (explanation.claim.best) {
    prospects.gain = gain_of(inquiry, analysis, explanation.claim);
    prospects.warnings = extended_run_warnings(inquiry, analysis.evidence, explanation);
  }
  for (Warning& warning : noise_warnings(analysis.evidence, explanation))
    prospects.warnings.push_back(std::move(warning));
  if (auto warning = memory_warning(inquiry, analysis)) prospects.warnings.push_back(std::move(*warning));
  inquiry.report("what could still hide", 0.85);
  prospects.detectable = detectable(inquiry, analysis);
  inquiry.report("the next experiment", 0.9);
  prospects.next = next_experiment(inquiry, analysis.evidence, explanation);
  return prospects;
}

}  // namespace tunica::diagnosis
