// SPDX-License-Identifier: Apache-2.0
#include "discovery/after_diagnosis.hpp"

#include <algorithm>
#include <utility>

#include "diagnosis/hypotheses/isotropy.hpp"

namespace tunica::discovery {

using diagnosis::Verdict;

std::optional<Discovery> after(const diagnosis::Diagnosis& d, const experiment::Experiment& experiment,
                               const plugins::Catalogue& catalogue, const diagnosis::Progress& progress) {
  const assembly::Assembly& base = *d.analysis.evidence.base;
  if (d.explanation.verdict != Verdict::unknown || !d.analysis.alarm.raised) return std::nullopt;
  if (d.request.model.empty() || base.models().count() != 1 || base.layout().has_costly_tests) return std::nullopt;
  if (!d.request.mechanisms.empty()) return std::nullopt;  // the catalogue was not asked
  if (!catalogue.models().contains("composed")) return std::nullopt;
  Request request = request_of(experiment);
  request.model = d.request.model;
  request.from_nothing = false;
  request.alpha = d.request.alpha;
  request.quick = d.request.quick;
  request.seed = d.request.seed;
  const experiment::Experiment measured = experiment::measured_only(experiment);
  const diagnosis::Inquiry inquiry{measured, d.request, catalogue, progress};
  return discover_in(inquiry, d.analysis, request, !diagnosis::is_isotropic(base.models().model(0)));
}

diagnosis::Diagnosis with_verdict_of(const Discovery& discovery, diagnosis::Diagnosis d) {
  if (discovery.verdict != Verdict::discovered) return d;
  d.explanation.verdict = Verdict::discovered;
  for (const Reason& reason : discovery.reasons) {
    std::string clause = reason.text;
    if (!clause.empty() && clause.back() == '.') clause.pop_back();
    d.explanation.reasons.push_back({diagnosis::ReasonKind::terms_discovered, std::move(clause)});
  }
  return d;
}

}  // namespace tunica::discovery
