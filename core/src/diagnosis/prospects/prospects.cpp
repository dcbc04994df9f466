// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/prospects/prospects.hpp"

#include "diagnosis/evidence/large_noise.hpp"
#include "diagnosis/evidence/vanishing_noise.hpp"
#include "diagnosis/prospects/detectable.hpp"
#include "diagnosis/prospects/extended_run.hpp"
#include "diagnosis/prospects/gain.hpp"
#include "diagnosis/prospects/next_experiment.hpp"

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

}  // namespace

Prospects prospects_of(const Inquiry& inquiry, const Analysis& analysis, const Explanation& explanation) {
  Prospects prospects;
  if (explanation.claim.best) {
    prospects.gain = gain_of(inquiry, analysis, explanation.claim);
    prospects.warnings = extended_run_warnings(inquiry, analysis.evidence, explanation);
  }
  for (Warning& warning : noise_warnings(analysis.evidence, explanation))
    prospects.warnings.push_back(std::move(warning));
  inquiry.report("what could still hide", 0.85);
  prospects.detectable = detectable(inquiry, analysis);
  inquiry.report("the next experiment", 0.9);
  prospects.next = next_experiment(inquiry, analysis.evidence, explanation);
  return prospects;
}

}  // namespace tunica::diagnosis
