// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/detection/alarm.hpp"

#include <algorithm>

#include "diagnosis/detection/noise_draws.hpp"
#include "diagnosis/detection/refit_draws.hpp"
#include "diagnosis/detection/squares.hpp"

namespace tunica::diagnosis {
namespace {

constexpr std::size_t linear_draws = 10000, quick_draws = 4000, refits = 199;

/// The largest factor on the noise at which the alarm still holds.
std::optional<double> noise_that_silences(const Detector& detector, const Fit& fit, double alpha) {
  constexpr double step = 1.05, most = 20;
  double factor = 1;
  while (factor * step < most && detector.test(-fit.residuals / (factor * step)).p <= alpha) factor *= step;
  return factor > 1 ? std::optional(factor) : std::nullopt;
}

/// From refits; from the linear draws below the resolution of that many refits.
double refined_p(const Inquiry& inquiry, const Evidence& evidence, const Alarm& alarm) {
  const double p = p_from_refits(inquiry, evidence, *alarm.detector, alarm.detection, refits);
  const bool none_was_worse = p * (refits + 1) < 1.5;
  return none_was_worse ? std::min(p, std::max(alarm.detection.p, 0.1 / refits)) : p;
}

}  // namespace

Alarm alarm_of(const Inquiry& inquiry, const Evidence& evidence, const Hypotheses& hypotheses) {
  const Fit& fit = evidence.fit;
  const auto rows = fit.residuals.size();
  Alarm alarm;
  alarm.shapes = smooth_shapes(evidence.curves, rows);
  alarm.draws = noise_draws(evidence, inquiry.request.quick ? quick_draws : linear_draws, inquiry.request.seed);
  alarm.detector = std::make_shared<const Detector>(hypotheses.projection, hypotheses.directions,
                                                    hypotheses.candidates.size(), alarm.shapes, alarm.draws);
  alarm.detection = alarm.detector->test(-fit.residuals);
  const double p_squares = p_of_squares(evidence, fit);
  if (!inquiry.request.quick) {
    inquiry.report("refits of simulated data", 0.2);
    alarm.p_refits = std::min(refined_p(inquiry, evidence, alarm), p_squares);
  }
  alarm.detection.p = std::min(alarm.detection.p, p_squares);
  alarm.raised = alarm.p() <= inquiry.request.alpha;
  if (alarm.raised) alarm.factor = noise_that_silences(*alarm.detector, fit, inquiry.request.alpha);
  return alarm;
}

}  // namespace tunica::diagnosis
