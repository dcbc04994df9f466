// SPDX-License-Identifier: Apache-2.0
#include "discovery/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace tunica::discovery {

using diagnosis::Verdict;

std::vector<FoundTerm> terms_of(const SetFit& best, const Judgement& judgement) {
  const auto& layout = best.set->assembly().layout();
  const Eigen::MatrixXd C = covariance(best.fit);
  std::vector<FoundTerm> terms;
  for (std::size_t k = 0; k < best.kinds.size(); ++k) {
    const BoundTerm& bound = best.set->terms()[k];
    const KindPointer& kind = best.kinds[k];
    FoundTerm term{bound.name, kind, probability_of(judgement, *kind), probability_of_invariant(judgement, *kind),
                   {},         {}};
    const auto add = [&](std::size_t j, const std::string& name) {
      const auto at = static_cast<Eigen::Index>(j);
      const double half = 1.96 * std::sqrt(std::max(C(at, at), 0.0)), value = best.fit.free[j];
      term.parameters.push_back(
          {name, layout.parameters[j].unit, value, value - half, value + half, best.fit.at_bound[j], true});
    };
    add(bound.amplitude, kind->amplitude());
    for (std::size_t h = 0; h < bound.heights.size(); ++h) add(bound.heights[h], kind->heights[h]);
    for (std::size_t s = 0; s < bound.shapes.size(); ++s) add(bound.shapes[s], kind->shapes[s].name);
    terms.push_back(std::move(term));
  }
  return terms;
}

Discovery nothing_missing(const Request& request, diagnosis::Analysis analysis) {
  Discovery found{request, std::move(analysis), nullptr};
  const bool gross = !found.analysis.evidence.gross.empty();
  found.judgement.verdict = gross ? Verdict::suspect_data : Verdict::nothing_detected;
  found.judgement.reasons.push_back(
      gross ? Reason{ReasonKind::gross_rows,
                     "Single rows are all that is wrong; without them the residuals could be noise."}
            : Reason{ReasonKind::residuals_like_noise,
                     fmt::format("The residuals could be noise (p = {:.2g}); there is nothing to discover.",
                                 found.analysis.alarm.p())});
  found.chi2_before = found.chi2_after = found.analysis.evidence.fit.chi2;
  found.p_after = found.analysis.alarm.p();
  found.warnings = found.analysis.evidence.warnings;
  return found;
}

void settle(Discovery& found, const std::vector<SetFit>& sets) {
  const diagnosis::Evidence& evidence = found.analysis.evidence;
  Findings findings{found.request.from_nothing, {}, found.rivals, found.paths};
  for (const SetFit& set : sets) findings.sets.push_back({set.kinds, set.log_evidence, set.chi2()});
  findings.rows = static_cast<double>(evidence.fit.residuals.size());
  findings.chi2_before = evidence.fit.chi2;
  findings.chi2_after = found.chi2_after;
  findings.p_after = found.p_after;
  found.judgement = judge(findings);
  if (found.judgement.offers_terms) found.terms = terms_of(*found.best, found.judgement);
}

}  // namespace tunica::discovery
