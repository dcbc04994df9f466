// SPDX-License-Identifier: Apache-2.0
#include "discovery/discovery.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/evidence/anisotropy.hpp"
#include "diagnosis/evidence/encompassing_noise.hpp"
#include "diagnosis/hypotheses/volume.hpp"
#include "diagnosis/naming/remainder.hpp"
#include "diagnosis/prospects/gain.hpp"
#include "discovery/next.hpp"
#include "discovery/preparation.hpp"
#include "discovery/remainder.hpp"
#include "discovery/search.hpp"
#include "discovery/verdict.hpp"
#include "text/lists.hpp"

namespace tunica::discovery {
namespace {

// Of a field, where every evaluation takes tens of milliseconds.
constexpr std::size_t narrow_beam = 4, narrow_exchange = 2;
constexpr Effort short_fits{.evaluations = 20, .starts = 1};

struct SpecimenSearch {
  std::shared_ptr<const Subject> subject;
  std::vector<SetFit> sets;  ///< likeliest first
  std::string anisotropy = {};
};

/// Whether points of a field were measured: these strain along all directions at once.
bool sees_directions(const diagnosis::Evidence& evidence) {
  return std::ranges::any_of(evidence.curves, [](const diagnosis::Curve& curve) { return !curve.x.empty(); });
}

/// All sets of closed laws, and of curves where these say more. `ends_where_far`: where the sets before are far from
/// noise, they are the answer.
std::vector<SetFit> searched_over(const diagnosis::Analysis& analysis, const Request& request, const Fitter& fitter,
                                  const std::vector<KindPointer>& kinds, const std::vector<CommonFit>& before,
                                  bool narrow, bool ends_where_far) {
  constexpr double worth_a_curve = 3;
  const auto is_clean = [&](const SetFit& fit) { return diagnosis::is_clean(p_of_rest(analysis, fit.fit)); };
  const CommonFitter one({&fitter}, {kinds}, request.from_nothing);
  std::vector<SetFit> sets;
  Search how{request.term_limit(), request.most_parameters, &before};
  if (narrow) how.beam = narrow_beam, how.exchanged = narrow_exchange;
  how.linear_first = narrow && sees_directions(analysis.evidence) && request.laws.empty();
  how.ends_where_far = ends_where_far;
  auto found = search(one, how, [&](const CommonFit& set) { return is_clean(set.specimens.front()); });
  const bool ends = how.ends_where_far && !before.empty() && !found.empty() && is_far(found.front());
  for (CommonFit& fit : found) sets.push_back(std::move(fit.specimens.front()));
  const std::vector<std::string>& laws = request.laws;
  if (sets.empty() || !(laws.empty() || std::find(laws.begin(), laws.end(), "spline") != laws.end())) return sets;
  if (narrow || ends || request.most_parameters > 0) return sets;  // a curve has more parameters
  const bool room = sets.front().kinds.size() < request.term_limit();
  const double best = sets.front().log_evidence;
  for (SetFit& curve : with_curves(fitter, sets.front(), kinds, room && !is_clean(sets.front())))
    if (curve.log_evidence > best + worth_a_curve) sets.push_back(std::move(curve));
  std::stable_sort(sets.begin(), sets.end(),
                   [](const SetFit& a, const SetFit& b) { return a.log_evidence > b.log_evidence; });
  return sets;
}

std::vector<CommonFit> as_common(const std::vector<SetFit>& sets) {
  std::vector<CommonFit> all;
  for (const SetFit& set : sets) all.push_back({set.kinds, {set}, set.log_evidence});
  return all;
}

/// "two directions answer differently: of those tried, the best terms without directions leave |r|² 4711, and those
/// with fibres 815; the base has no directions"
std::string directions_of_field(const SetFit& without, const SetFit& with, bool from_nothing) {
  return fmt::format(
      "two directions answer differently: of those tried, the best terms without directions leave |r|² {:.0f}, and "
      "those with fibres {:.0f}{}",
      without.chi2(), with.chi2(), from_nothing ? "" : "; the base has no directions");
}

/// Fibres of an isotropic base are tried where its terms leave more than noise and the data show two directions; in a
/// field, where terms without directions are no match for them.
/// `before`: sets of a search with another noise.
SpecimenSearch search_one(const diagnosis::Inquiry& inquiry, const diagnosis::Analysis& analysis,
                          const Request& request, bool has_directions, const std::vector<SetFit>& before, bool narrow,
                          Effort effort = {}) {
  const diagnosis::Evidence& evidence = analysis.evidence;
  auto subject = std::make_shared<const Subject>(
      Subject{evidence.experiment, evidence.run, request.model, request.from_nothing, inquiry.catalogue,
              request.from_nothing && diagnosis::changes_volume(*evidence.base)});
  inquiry.report("what the data reach", 0.3);
  const States states = reached_states(*subject, evidence.fit.free);
  Fitter fitter(*subject, evidence, effort);
  const bool volume = sees_volume(*subject, evidence);
  const auto over = [&](bool directions, const std::vector<CommonFit>& sets_before, bool ends_where_far) {
    const auto kinds = scaled_kinds(fitter, kinds_of(request, states, directions, volume));
    if (subject->changes_volume) fitter.begin_with(kinds);
    return searched_over(analysis, request, fitter, kinds, sets_before, narrow, ends_where_far);
  };
  inquiry.report("terms of the energy", 0.4);
  SpecimenSearch found{subject, over(has_directions, as_common(before), request.quick && !request.from_nothing)};
  const bool clean = !found.sets.empty() && diagnosis::is_clean(p_of_rest(analysis, found.sets.front().fit));
  if (!has_directions) found.anisotropy = diagnosis::anisotropy_words(evidence);
  const bool in_field = !has_directions && found.anisotropy.empty() && sees_directions(evidence);
  if ((!found.anisotropy.empty() || in_field) && !clean && request.invariants.empty()) {
    inquiry.report("terms of fibres", 0.6);
    std::vector<SetFit> with_fibres = over(true, as_common(found.sets), false);  // none of these has fibres
    // A field says by the terms alone that two directions differ, so that there they must be clearly better.
    const auto are_better = [in_field](const SetFit& with, const SetFit& without) {
      return in_field && with.has_fibres() ? with.is_clearly_better_than(without)
                                           : with.log_evidence > without.log_evidence;
    };
    if (!with_fibres.empty() && (found.sets.empty() || are_better(with_fibres.front(), found.sets.front()))) {
      if (in_field && !found.sets.empty() && with_fibres.front().has_fibres())
        found.anisotropy = directions_of_field(found.sets.front(), with_fibres.front(), request.from_nothing);
      found.sets = std::move(with_fibres);
    }
  }
  if (!found.sets.empty())
    simplest_first(found.sets, [&](const SetFit& fit) { return diagnosis::is_clean(p_of_rest(analysis, fit.fit)); });
  return found;
}

std::vector<diagnosis::HeldOut> gain_of(const diagnosis::Inquiry& inquiry, const diagnosis::Evidence& evidence,
                                        const SetFit& best) {
  const std::vector<diagnosis::Variable> variables = diagnosis::all_variables(best.set->assembly());
  std::vector<std::size_t> needed;
  for (const BoundTerm& term : best.set->terms()) needed.push_back(term.amplitude);
  return diagnosis::held_out_blocks(inquiry, evidence, {best.set->assembly(), variables, best.fit, needed});
}

}  // namespace

namespace {

/// The best set fitted with the tests themselves, from where the search with their stand-ins ended; none where it
/// cannot be fitted.
std::optional<SetFit> with_own_tests(const Discovery& found, const StandIns& stand_ins) {
  Subject own = *found.subject;
  own.experiment = stand_ins.restored(std::move(own.experiment));
  SetFit fit = *found.best;
  fit.set = std::make_shared<const BoundSet>(own, fit.kinds);
  const assembly::Assembly& assembly = fit.set->assembly();
  fit.fit = diagnosis::least_squares(assembly, diagnosis::all_variables(assembly), fit.fit.free,
                                     *assembly.evaluator().make_workspace(), 30);
  if (!fit.fit.status.ok()) return std::nullopt;
  return fit;
}

}  // namespace

Discovery discover_in(const diagnosis::Inquiry& inquiry, diagnosis::Analysis analysis, const Request& request,
                      bool has_directions, const StandIns& stand_ins) {
  // Noise that the residuals of the base said is asked once more of what the terms leave. A quick search for it is
  // narrow and its fits are short, because another one decides; that begins where the first ended.
  const bool narrow = !stand_ins.empty(), first_of_two = request.quick && diagnosis::has_open_noise(analysis.evidence);
  SpecimenSearch searched = search_one(inquiry, analysis, request, has_directions, {}, narrow || first_of_two,
                                       first_of_two ? short_fits : Effort{});
  if (!searched.sets.empty()) {
    auto again = diagnosis::restated(inquiry, analysis, searched.sets.front().fit);
    const bool decided = !again && !first_of_two;
    if (again) analysis = std::move(*again);
    if (!decided) searched = search_one(inquiry, analysis, request, has_directions, searched.sets, narrow);
  }
  Discovery found{request, std::move(analysis), searched.subject};
  found.stand_ins = stand_ins;
  found.anisotropy = searched.anisotropy;
  found.chi2_before = found.analysis.evidence.fit.chi2;
  found.chi2_after = found.analysis.evidence.fit.chi2;
  found.sets_tried = searched.sets.size();
  std::string finished_by;
  inquiry.report("mechanisms as rivals", 0.8);
  if (!request.from_nothing) found.rivals = rivals_of(inquiry, found.analysis);
  if (!searched.sets.empty()) {
    found.best = searched.sets.front();
    if (!stand_ins.empty()) {
      inquiry.report("the terms with the tests themselves", 0.9);
      auto finished = with_own_tests(found, stand_ins);
      finished_by = finished ? "the best of them fitted with the own one"
                             : "the best of them could not be fitted with the own one";
      if (finished) found.best = std::move(*finished);
    }
    found.chi2_after = found.best->chi2();
    found.p_after = p_of_rest(found.analysis, found.best->fit);
  }
  found.paths = path_dependence(found.analysis.evidence, found.best ? found.best->fit : found.analysis.evidence.fit);
  settle(found, searched.sets);
  if (!finished_by.empty())
    found.judgement.reasons.push_back(
        {ReasonKind::searched_cheaper,
         fmt::format("Terms were searched for, and weighed against each other, with a cheaper method of {}, and {}.",
                     fmt::join(stand_ins.names(), ", "), finished_by)});
  if (!searched.anisotropy.empty())
    found.judgement.reasons.push_back({ReasonKind::anisotropy_seen, text::capitalised(searched.anisotropy) + "."});
  if (!found.terms.empty()) {
    for (std::size_t k = 0; k < found.terms.size(); ++k)
      found.terms[k].curve = mixed_curve(*found.subject, searched.sets, k);
    found.held_out = gain_of(inquiry, found.analysis.evidence, *found.best);
    found.next = next_experiment(inquiry, found, searched.sets);
  }
  return found;
}

Discovery discover(const experiment::Experiment& experiment, const Request& request,
                   const plugins::Catalogue& catalogue, const diagnosis::Progress& progress) {
  check(request, catalogue);
  check_states(request, experiment);
  const experiment::RunEntry* const run = diagnosis::run_of_model(experiment, request.model);
  const StandIns stand_ins = run == nullptr ? StandIns() : StandIns(experiment, *run, catalogue);
  const bool directions = has_directions(experiment, request.model, catalogue);
  experiment::Experiment measured = stand_ins.cheaper(experiment::measured_only(experiment));
  const bool volume = request.from_nothing && changes_volume(measured, request.model, catalogue);
  if (request.from_nothing)
    measured = with_first_terms(std::move(measured), request.model, volume, *catalogue.term_model());
  const diagnosis::Request of_analysis = analysis_request(request);
  const diagnosis::Inquiry inquiry{measured, of_analysis, catalogue, progress};
  diagnosis::Analysis analysis = request.from_nothing ? diagnosis::analyse(inquiry, {}) : screened(inquiry);
  if (!request.from_nothing && !analysis.alarm.raised) return nothing_missing(request, std::move(analysis));
  Discovery found = discover_in(inquiry, std::move(analysis), request, directions, stand_ins);
  found.warnings.insert(found.warnings.end(), found.analysis.evidence.warnings.begin(),
                        found.analysis.evidence.warnings.end());
  found.warnings.insert(found.warnings.end(), found.analysis.evidence.noise_warnings.begin(),
                        found.analysis.evidence.noise_warnings.end());
  inquiry.report("done", 1);
  return found;
}

}  // namespace tunica::discovery
