// SPDX-License-Identifier: Apache-2.0
#include "discovery/after_diagnosis.hpp"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "diagnosis/hypotheses/isotropy.hpp"
#include "diagnosis/naming/naming.hpp"
#include "discovery/verdict.hpp"

namespace tunica::discovery {

using diagnosis::Verdict;

std::optional<Discovery> after(const diagnosis::Diagnosis& d, const experiment::Experiment& experiment,
                               const plugins::Catalogue& catalogue, const diagnosis::Progress& progress) {
  const assembly::Assembly& base = *d.analysis.evidence.base;
  if (d.explanation.verdict != Verdict::unknown || !d.analysis.alarm.raised) return std::nullopt;
  if (!diagnosis::can_search_terms(d.request, d.analysis.evidence, catalogue)) return std::nullopt;
  Request request = request_of(experiment);
  request.model = d.request.model;
  request.from_nothing = false;
  request.alpha = d.request.alpha;
  request.tolerance = d.request.tolerance;
  request.quick = d.request.quick;
  request.seed = d.request.seed;
  const bool directions = !diagnosis::is_isotropic(base.models().model(0));
  const experiment::Experiment measured = experiment::measured_only(experiment);
  if (!base.layout().has_costly_tests)
    return discover_in({measured, d.request, catalogue, progress}, d.analysis, request, directions);
  const StandIns stand_ins(measured, d.analysis.evidence.run, catalogue);
  if (!stand_ins.suffice(measured, d.analysis.evidence.run, catalogue)) return std::nullopt;
  const experiment::Experiment cheaper = stand_ins.cheaper(measured);
  const diagnosis::Inquiry inquiry{cheaper, d.request, catalogue, progress};
  return discover_in(inquiry, diagnosis::analyse(inquiry, d.analysis.evidence.gross), request, directions, stand_ins);
}

diagnosis::Diagnosis with_verdict_of(const Discovery& discovery, diagnosis::Diagnosis d) {
  if (discovery.judgement.verdict != Verdict::discovered) return d;
  d.explanation.verdict = Verdict::discovered;
  std::vector<KindPointer> kinds;
  for (const FoundTerm& term : discovery.terms) kinds.push_back(term.kind);
  auto& reasons = d.explanation.reasons;
  reasons.insert(reasons.begin(),
                 {diagnosis::ReasonKind::terms_discovered,
                  fmt::format("the energy lacks {}, |r|² {:.1f} → {:.1f}", lacking_words(discovery.judgement, kinds),
                              discovery.chi2_before, discovery.chi2_after)});
  if (!discovery.anisotropy.empty()) reasons.push_back({diagnosis::ReasonKind::anisotropy_seen, discovery.anisotropy});
  return d;
}

}  // namespace tunica::discovery
