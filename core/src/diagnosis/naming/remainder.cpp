// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/remainder.hpp"

#include <algorithm>
#include <vector>

#include "diagnosis/detection/squares.hpp"

namespace tunica::diagnosis {

Detector remainder_detector(const Analysis& analysis, const Refit& refit) {
  const Projection projection(interior(refit.fit));
  std::vector<Candidate> others = analysis.hypotheses.candidates;
  for (Candidate& candidate : others)
    for (const Addition& addition : refit.additions)
      if (candidate.id == addition.id)
        std::erase_if(candidate.hypotheses, [&](const Hypothesis& hypothesis) {
          return !addition.place.row || hypothesis.addition.place == addition.place;
        });
  return {projection, directions(others, projection), others.size(), analysis.alarm.shapes, analysis.alarm.draws};
}

double p_of_remainder(const Analysis& analysis, const Refit& refit) {
  const double p = remainder_detector(analysis, refit).test(-refit.fit.residuals).p;
  return std::min(p, p_of_squares(analysis.evidence, refit.fit));
}

std::optional<CleanAt> noise_that_explains_remainder(const Inquiry& inquiry, const Analysis& analysis,
                                                     const Refit& refit) {
  const Evidence& evidence = analysis.evidence;
  const Detector detector = remainder_detector(analysis, refit);
  Fit fit = refit.fit;
  for (double factor = 1.1; factor < 20; factor *= 1.1) {
    fit.residuals = refit.fit.residuals / factor;
    if (!is_clean(std::min(detector.test(-fit.residuals).p, p_of_squares(evidence, fit)))) continue;
    fit.residuals = evidence.fit.residuals / factor;
    const double alarm = std::min(analysis.alarm.detector->test(-fit.residuals).p, p_of_squares(evidence, fit));
    return CleanAt{factor, alarm <= inquiry.request.alpha};
  }
  return std::nullopt;
}

}  // namespace tunica::diagnosis
