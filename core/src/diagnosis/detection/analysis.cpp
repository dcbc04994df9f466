// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/detection/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/evidence/encompassing_noise.hpp"
#include "diagnosis/evidence/estimate_warnings.hpp"

namespace tunica::diagnosis {
namespace {

/// Evidence and hypotheses under the noise estimated from the residuals of a fit.
Analysis with_noise_of(const Inquiry& inquiry, const Evidence& evidence, const Hypotheses& hypotheses,
                       const NoiseEstimate& estimate) {
  Evidence stated = restated(inquiry, evidence, estimate);
  Hypotheses rescaled = restated(hypotheses, evidence, stated);
  return {std::move(stated), std::move(rescaled), {}};
}

/// The largest |ln σ′/σ| of a channel, at the largest of its values.
double change(const std::vector<NoiseSource>& before, const std::vector<NoiseSource>& after) {
  double most = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const data::Noise &a = before[k].noise, &b = after[k].noise;
    most = std::max(most, std::abs(std::log(b.absolute / a.absolute)));
    if (a.relative > 0 && b.relative > 0) most = std::max(most, std::abs(std::log(b.relative / a.relative)));
    if ((a.relative > 0) != (b.relative > 0)) most = INFINITY;
  }
  return most;
}

}  // namespace

Analysis analyse(const Inquiry& inquiry, const std::vector<GrossRow>& gross) {
  Evidence evidence = evidence_of(inquiry, gross);
  Hypotheses hypotheses = hypotheses_of(inquiry, evidence);
  Analysis analysis{std::move(evidence), std::move(hypotheses), {}};
  if (has_open_noise(analysis.evidence)) {
    analysis = with_noise_of(
        inquiry, analysis.evidence, analysis.hypotheses,
        encompassing_noise(analysis.evidence, analysis.evidence.fit, visible_signatures(analysis.hypotheses)));
    analysis.evidence.noise_warnings = estimate_warnings(analysis.evidence, analysis.evidence.fit);
  }
  analysis.alarm = alarm_of(inquiry, analysis.evidence, analysis.hypotheses);
  return analysis;
}

std::optional<Analysis> restated(const Inquiry& inquiry, const Analysis& analysis, const Fit& extension) {
  constexpr double a_tenth = 0.1;
  const Evidence& evidence = analysis.evidence;
  if (!has_open_noise(evidence)) return std::nullopt;
  const NoiseEstimate estimate = encompassing_noise(evidence, extension, visible_signatures(analysis.hypotheses));
  if (change(evidence.noise, estimate.sources) < a_tenth) return std::nullopt;
  Analysis again = with_noise_of(inquiry, evidence, analysis.hypotheses, estimate);
  again.evidence.noise_warnings = estimate_warnings(again.evidence, extension);
  again.alarm = alarm_of(inquiry, again.evidence, again.hypotheses);
  return again;
}

}  // namespace tunica::diagnosis
