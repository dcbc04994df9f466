// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/explanation.hpp"

#include <utility>

#include <fmt/format.h>

#include "diagnosis/naming/admissibility.hpp"
#include "diagnosis/naming/gross_causes.hpp"
#include "diagnosis/naming/misfit.hpp"
#include "diagnosis/naming/naming.hpp"
#include "diagnosis/naming/remainder.hpp"
#include "diagnosis/naming/unseen_rivals.hpp"

namespace tunica::diagnosis {
namespace {

Explanation noise_alone(const Analysis& analysis) {
  Explanation found;
  found.reasons.push_back(
      {ReasonKind::residuals_like_noise, fmt::format("the residuals could be noise (p = {:.2g})", analysis.alarm.p())});
  // The alarm looks for causes and smooth shapes; rows can scatter too much without either.
  const assembly::Misfit misfit = stated_misfit(analysis.evidence);
  if (misfit.contradicts() || misfit.small_but_real())
    found.reasons.push_back(
        {ReasonKind::rows_miss_the_model,
         fmt::format("no mechanism and no smooth shape stands out, and yet {}", assembly::in_words(misfit, "stated"))});
  return found;
}

/// Where an extension restores lost stability: what it leaves of the curves.
Explanation with_remainder(const Inquiry& inquiry, const Analysis& analysis, Explanation found) {
  found.p_after = p_of_remainder(analysis, *found.claim.best);
  return analysis.alarm.raised && !is_clean(found.p_after) ? unclean(inquiry, analysis, std::move(found))
                                                           : std::move(found);
}

/// What raised the alarm.
Explanation alarming(const Inquiry& inquiry, const Analysis& analysis, const std::vector<GrossRow>& gross) {
  if (gross.empty()) return named_causes(inquiry, analysis);
  Explanation found = suspected_rows(inquiry, analysis, gross);
  if (found.claim.best) found.p_after = p_of_remainder(analysis, *found.claim.best);
  return found;
}

/// An unstable material is wrong, however well it fits.
Explanation inadmissible(const Inquiry& inquiry, const Analysis& analysis, const Admissibility& admissibility,
                         const std::vector<GrossRow>& gross) {
  Explanation restored = stabilised(inquiry, analysis, admissibility);
  if (restored.claim.best) return with_remainder(inquiry, analysis, std::move(restored));
  if (!analysis.alarm.raised) return restored;
  Explanation found = alarming(inquiry, analysis, gross);
  found.reasons.insert(found.reasons.begin(), restored.reasons.begin(), restored.reasons.end());
  // A cause may explain the curves, but is incomplete if the material stays unstable under it.
  if (gross.empty() && found.verdict == Verdict::named) found.verdict = Verdict::unknown;
  return found;
}

}  // namespace

Standing standing_of(const Cause& cause, const Explanation& explanation) {
  if (!cause.amplitude.plausible) return Standing::implausible;
  if (cause.amplitude.at_bound) return Standing::at_bound;
  return is_clean(explanation.p_after) ? Standing::probable : Standing::rest_is_left;
}

Explanation explain(const Inquiry& inquiry, const Analysis& analysis, const std::vector<GrossRow>& gross) {
  const Hypotheses& hypotheses = analysis.hypotheses;
  Admissibility admissibility = admissibility_of(analysis.evidence);
  const bool unstable = inquiry.request.admissibility && admissibility.stable == false;
  if (analysis.alarm.raised || unstable) inquiry.report("fitting the mechanisms", 0.4);
  Explanation found = unstable                ? inadmissible(inquiry, analysis, admissibility, gross)
                      : analysis.alarm.raised ? alarming(inquiry, analysis, gross)
                                              : noise_alone(analysis);
  admissibility.remedy = found.admissibility.remedy;
  found.admissibility = std::move(admissibility);
  found.gross = gross;
  limit_by_unseen_rivals(inquiry, analysis, found);
  if (found.best_direction.empty())
    for (std::size_t c = 0; c < hypotheses.candidates.size(); ++c)
      found.best_direction.push_back(likeliest_direction(hypotheses.directions, -analysis.evidence.fit.residuals, c));
  found.misfit = misfits(inquiry, analysis, found.claim);
  found.left_out = causes_of_rows(inquiry, analysis, found.claim);
  return found;
}

}  // namespace tunica::diagnosis
