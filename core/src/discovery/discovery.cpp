// SPDX-License-Identifier: Apache-2.0
#include "discovery/discovery.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "diagnosis/evidence/gross_rows.hpp"
#include "diagnosis/hypotheses/isotropy.hpp"
#include "diagnosis/naming/remainder.hpp"
#include "diagnosis/prospects/gain.hpp"
#include "discovery/remainder.hpp"
#include "discovery/verdict.hpp"
#include "plugins/guarded.hpp"
#include "tunica/error.hpp"

namespace tunica::discovery {
namespace {

/// What is searched, with amplitudes that the data can hold.
std::vector<KindPointer> scaled_kinds(const Fitter& fitter, std::vector<Kind> kinds) {
  tbb::parallel_for(std::size_t{0}, kinds.size(),
                    [&](std::size_t k) { kinds[k].largest = fitter.largest_amplitude(kinds[k]); });
  std::vector<KindPointer> shared;
  for (Kind& kind : kinds)
    if (kind.largest != 0) shared.push_back(std::make_shared<const Kind>(std::move(kind)));
  return shared;
}

struct Searched {
  std::shared_ptr<const Subject> subject;
  std::vector<SetFit> sets;  ///< likeliest first
};

/// All sets of closed laws, and of curves where these say more.
Searched search_in(const diagnosis::Inquiry& inquiry, const diagnosis::Analysis& analysis, const Request& request,
                   bool has_directions) {
  constexpr double worth_a_curve = 3;
  const diagnosis::Evidence& evidence = analysis.evidence;
  auto subject = std::make_shared<const Subject>(
      Subject{evidence.experiment, evidence.run, request.model, request.from_nothing, inquiry.catalogue});
  inquiry.report("what the data reach", 0.3);
  const States states = reached_states(*subject, evidence.fit.free);
  const Fitter fitter(*subject, evidence);
  const std::vector<KindPointer> kinds = scaled_kinds(fitter, kinds_of(request, states, has_directions));
  inquiry.report("terms of the energy", 0.4);
  Searched found{subject, search(fitter, {kinds, request.term_limit(), request.from_nothing},
                                 [&](const SetFit& fit) { return diagnosis::is_clean(p_of_rest(analysis, fit.fit)); })};
  const bool curves =
      request.laws.empty() || std::find(request.laws.begin(), request.laws.end(), "spline") != request.laws.end();
  if (found.sets.empty() || !curves) return found;
  inquiry.report("curves in the place of laws", 0.7);
  const bool clean = diagnosis::is_clean(p_of_rest(analysis, found.sets.front().fit));
  const bool room = found.sets.front().kinds.size() < request.term_limit();
  for (SetFit& curve : with_curves(fitter, found.sets.front(), kinds, !clean && room))
    if (curve.log_evidence > found.sets.front().log_evidence + worth_a_curve) found.sets.push_back(std::move(curve));
  std::stable_sort(found.sets.begin(), found.sets.end(),
                   [](const SetFit& a, const SetFit& b) { return a.log_evidence > b.log_evidence; });
  return found;
}

/// Rows that are gross take no part.
diagnosis::Analysis screened(const diagnosis::Inquiry& inquiry) {
  diagnosis::Analysis whole = diagnosis::analyse(inquiry, {});
  if (!whole.alarm.raised) return whole;
  const auto gross = diagnosis::gross_rows(whole.evidence);
  return gross.empty() ? std::move(whole) : diagnosis::analyse(inquiry, gross);
}

/// Whether the material that the file describes has directions of its own.
bool has_directions(const experiment::Experiment& experiment, const std::string& name,
                    const plugins::Catalogue& catalogue) {
  const experiment::ModelEntry& entry = experiment.model(name);
  return !diagnosis::is_isotropic(*plugins::create(catalogue.models().at(entry.type), entry.options));
}

std::vector<diagnosis::HeldOut> gain_of(const diagnosis::Inquiry& inquiry, const diagnosis::Evidence& evidence,
                                        const SetFit& best) {
  const std::vector<diagnosis::Variable> variables = diagnosis::all_variables(best.set->assembly());
  std::vector<std::size_t> needed;
  for (const BoundTerm& term : best.set->terms()) needed.push_back(term.amplitude);
  return diagnosis::held_out_blocks(inquiry, evidence, {best.set->assembly(), variables, best.fit, needed});
}

}  // namespace

Discovery discover_in(const diagnosis::Inquiry& inquiry, diagnosis::Analysis analysis, const Request& request,
                      bool has_directions) {
  Searched searched = search_in(inquiry, analysis, request, has_directions);
  // Noise that the residuals of the base said is asked once more of what the terms leave.
  if (!searched.sets.empty())
    if (auto again = diagnosis::restated(inquiry, analysis, searched.sets.front().fit)) {
      analysis = std::move(*again);
      searched = search_in(inquiry, analysis, request, has_directions);
    }
  Discovery found{request, std::move(analysis), searched.subject};
  found.chi2_before = request.from_nothing ? 0 : found.analysis.evidence.fit.chi2;
  found.chi2_after = found.analysis.evidence.fit.chi2;
  found.sets_tried = searched.sets.size();
  inquiry.report("mechanisms as rivals", 0.8);
  if (!request.from_nothing) found.rivals = rivals_of(inquiry, found.analysis);
  if (!searched.sets.empty()) {
    found.best = searched.sets.front();
    found.chi2_after = found.best->chi2();
    found.p_after = p_of_rest(found.analysis, found.best->fit);
  }
  found.paths = path_dependence(found.analysis.evidence, found.best ? found.best->fit : found.analysis.evidence.fit);
  judge(found, searched.sets);
  if (found.best) {
    for (std::size_t k = 0; k < found.terms.size(); ++k)
      found.terms[k].curve = curve_of_term(*found.subject, *found.best, k);
    found.held_out = gain_of(inquiry, found.analysis.evidence, *found.best);
  }
  return found;
}

Discovery discover(const experiment::Experiment& experiment, const Request& request,
                   const plugins::Catalogue& catalogue, const diagnosis::Progress& progress) {
  if (request.model.empty())
    throw InputError(
        "discovery: every test names the models of its layers, so that it is open which of them gets the terms. Name "
        "one in \"discovery\": {\"model\": …}");
  if (!catalogue.models().contains("composed"))
    throw InputError(
        "discovery: no loaded plugin provides the model 'composed', which terms are written in. Add its "
        "folder to the plugin path");
  const bool directions = has_directions(experiment, request.model, catalogue);
  experiment::Experiment measured = experiment::measured_only(experiment);
  if (request.from_nothing) measured = with_first_term(std::move(measured), request.model);
  const diagnosis::Request of_analysis = analysis_request(request);
  const diagnosis::Inquiry inquiry{measured, of_analysis, catalogue, progress};
  diagnosis::Analysis analysis = request.from_nothing ? diagnosis::analyse(inquiry, {}) : screened(inquiry);
  if (!request.from_nothing && !analysis.alarm.raised) return nothing_missing(request, std::move(analysis));
  Discovery found = discover_in(inquiry, std::move(analysis), request, directions);
  found.warnings.insert(found.warnings.end(), found.analysis.evidence.warnings.begin(),
                        found.analysis.evidence.warnings.end());
  found.warnings.insert(found.warnings.end(), found.analysis.evidence.noise_warnings.begin(),
                        found.analysis.evidence.noise_warnings.end());
  inquiry.report("done", 1);
  return found;
}

}  // namespace tunica::discovery
