// SPDX-License-Identifier: Apache-2.0
#include "budget/budget.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "assembly/memory.hpp"
#include "budget/decision.hpp"
#include "budget/same_model.hpp"
#include "diagnosis/evidence/anisotropy.hpp"
#include "diagnosis/evidence/encompassing_noise.hpp"
#include "diagnosis/hypotheses/isotropy.hpp"
#include "diagnosis/naming/naming.hpp"
#include "diagnosis/naming/remainder.hpp"
#include "discovery/preparation.hpp"
#include "text/misfit_words.hpp"

namespace tunica::budget {
namespace {

using diagnosis::Verdict;

constexpr const char* terms_of_the_energy = "terms of the energy";

/// Whether the verdict rests on causes or terms after which only noise is left.
bool is_settled(const diagnosis::Diagnosis& d, const discovery::Discovery* search) {
  switch (d.explanation.verdict) {
    case Verdict::nothing_detected:
    case Verdict::named:
    case Verdict::suspect_data:
    case Verdict::indistinguishable:
      return true;
    case Verdict::discovered:
      return search != nullptr && diagnosis::is_clean(search->p_after);
    case Verdict::leading:
    case Verdict::unknown:
      break;
  }
  // Too many explanations that all leave only noise do not make an unlisted misfit.
  return d.explanation.claim.best && diagnosis::is_clean(d.explanation.p_after);
}

/// The model that terms can be added to; none: there is no single one.
std::optional<discovery::Subject> subject_of(const diagnosis::Diagnosis& d, const diagnosis::Evidence& evidence,
                                             const plugins::Catalogue& catalogue) {
  if (!diagnosis::can_search_terms(d.request, evidence, catalogue)) return std::nullopt;
  return discovery::Subject{evidence.experiment, evidence.run, d.request.model, false, catalogue};
}

/// `directions`: a search has found fibres to be better than all terms without directions.
std::vector<discovery::KindPointer> kinds_for(const diagnosis::Diagnosis& d, const diagnosis::Evidence& evidence,
                                              const discovery::Subject& subject, bool directions) {
  discovery::Request request;
  request.model = d.request.model;
  // Fibres of an isotropic base are looked for where the data show two directions, and nowhere else.
  directions = directions || !diagnosis::is_isotropic(evidence.base->models().model(0)) ||
               !diagnosis::anisotropy_words(evidence, tolerance_of(d.request, evidence).share).empty();
  const discovery::Fitter fitter(subject, evidence);
  return discovery::scaled_kinds(
      fitter, discovery::kinds_of(request, discovery::reached_states(subject, evidence.fit.free), directions));
}

std::vector<std::string> ids_of(const std::vector<diagnosis::Addition>& additions) {
  std::vector<std::string> ids;
  for (const diagnosis::Addition& one : additions) ids.push_back(one.id);
  return ids;
}

/// Groups that the request leaves out; mechanisms that are asked for by name may be of any.
std::vector<Budget::Untried> left_out(const diagnosis::Request& request) {
  std::vector<Budget::Untried> all;
  if (!request.mechanisms.empty()) return all;
  if (!request.considers(code_of(diagnosis::CauseGroup::material)))
    all = {{"causes in the material", Budget::Lack::group}, {terms_of_the_energy, Budget::Lack::group}};
  if (!request.considers(code_of(diagnosis::CauseGroup::rig)))
    all.push_back({"causes in the rig", Budget::Lack::group});
  return all;
}

std::vector<Budget::Untried> not_looked_for(const diagnosis::Diagnosis& d, const plugins::Catalogue& catalogue,
                                            bool searched) {
  const diagnosis::Evidence& evidence = d.analysis.evidence;
  std::set<std::string> unordered;
  for (const assembly::TestPast& one : assembly::unknown_pasts(evidence.experiment, evidence.run, catalogue))
    if (one.past == data::Past::order_unknown) unordered.insert(one.test);
  std::vector<Budget::Untried> all = left_out(d.request);
  const bool of_material = d.request.considers(code_of(diagnosis::CauseGroup::material));
  if (evidence.base->layout().has_costly_tests && !searched && of_material)
    all.push_back({terms_of_the_energy, Budget::Lack::time});
  for (const diagnosis::Candidate& one : d.analysis.hypotheses.candidates) {
    if (!one.hypotheses.empty()) continue;
    const bool order = std::any_of(one.without_past.begin(), one.without_past.end(),
                                   [&](const std::string& test) { return unordered.contains(test); });
    if (one.absence == diagnosis::Absence::no_clock)
      all.push_back({one.id, Budget::Lack::clock});
    else if (one.absence == diagnosis::Absence::no_volume)
      all.push_back({one.id, Budget::Lack::volume});
    else if (one.absence == diagnosis::Absence::no_size)
      all.push_back({one.id, Budget::Lack::size});
    else if (!one.without_past.empty())
      all.push_back({one.id, order ? Budget::Lack::order : Budget::Lack::loading});
  }
  return all;
}

/// A noise that is estimated may be so small in one channel that the fit follows it and misses another one by most of
/// its range. "axial_force to 0.04 % of its range and outer_diameter to 1.0 %"
std::string lopsided_words(const diagnosis::Evidence& evidence, const std::vector<ChannelSize>& channels) {
  constexpr double far = 0.3, several = 5;  // far: of the range
  if (!diagnosis::has_open_noise(evidence)) return {};
  /// Of a channel whose noise is estimated.
  const auto sigma = [&](const ChannelSize& channel) {
    for (const diagnosis::NoiseSource& one : evidence.noise)
      if (one.open() && one.test == channel.test && one.channel == channel.channel)
        return one.noise.absolute / channel.range;
    return 0.0;
  };
  const ChannelSize *followed = nullptr, *missed = nullptr;
  for (const ChannelSize& one : channels) {
    if (sigma(one) > 0 && (!followed || sigma(one) < sigma(*followed))) followed = &one;
    if (!missed || one.of_range().rms > missed->of_range().rms) missed = &one;
  }
  if (!followed || missed->of_range().rms < far || sigma(*missed) < several * sigma(*followed)) return {};
  return fmt::format("{} to {} of its range and {} to {}", followed->channel, text::percent(sigma(*followed)),
                     missed->channel, text::percent(sigma(*missed)));
}

}  // namespace

Budget budget_of(const diagnosis::Diagnosis& d, const discovery::Discovery* search,
                 const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                 const diagnosis::Progress& progress) {
  const bool costly = d.analysis.evidence.base->layout().has_costly_tests;
  // Where a test is a series of simulations, every further fit costs as much as the diagnosis. A search with a cheaper
  // method has seen the same data; what comes out best is fitted with the tests themselves.
  const bool stands_in = costly && search != nullptr && !search->stand_ins.empty();
  const diagnosis::Analysis& analysis = stands_in ? search->analysis : d.analysis;
  const MisfitSize size(analysis.evidence), own_size(d.analysis.evidence);
  Budget budget;
  budget.tolerance = tolerance_of(d.request, d.analysis.evidence);
  if (d.analysis.alarm.raised) budget.not_looked_for = not_looked_for(d, catalogue, stands_in);
  budget.base = own_size.of(d.analysis.evidence.fit);
  budget.base_channels = budget.rest_channels = own_size.channels(d.analysis.evidence.fit);
  budget.lopsided = lopsided_words(d.analysis.evidence, budget.base_channels);
  const experiment::Experiment measured = experiment::measured_only(experiment);
  const diagnosis::Inquiry own_inquiry{measured, d.request, catalogue, progress};
  const auto own_subject = subject_of(d, d.analysis.evidence, catalogue);
  const auto subject = costly && !stands_in ? std::nullopt : subject_of(d, analysis.evidence, catalogue);
  const auto name_model = [&](std::vector<std::string> causes, const assembly::Assembly& extended,
                              const diagnosis::Fit& fit, const std::vector<diagnosis::Addition>& additions) {
    if (!subject || causes.empty() || costly) return;
    budget.same_model = same_model(*subject, analysis.evidence, extended, fit, additions);
    if (!budget.same_model.empty()) budget.same_with = std::move(causes);
  };
  const auto finish = [&](std::optional<Mixture> fitted) {
    if (stands_in) budget.cheaper = Budget::Cheaper{search->stand_ins.names(), std::nullopt};
    if (fitted && stands_in) {
      own_inquiry.report("the causes with the tests themselves", 0.99);
      fitted = Mixer(own_inquiry, d.analysis, own_subject ? &*own_subject : nullptr).again(*fitted);
      if (fitted) {
        budget.steps.back().rest = own_size.of(fitted->fit);
        budget.cheaper->own_share =
            1 - own_size.squares(fitted->fit) / std::max(own_size.squares(d.analysis.evidence.fit), 1e-300);
      }
    }
    if (fitted) {
      budget.rest_channels = own_size.channels(fitted->fit);
      std::vector<std::string> causes;
      for (const Member& member : fitted->members) causes.push_back(member.words());
      name_model(std::move(causes), fitted->extension->assembly(), fitted->fit, fitted->extension->additions());
      budget.fitted = std::make_shared<const Mixture>(std::move(*fitted));
    }
    budget.adequate = budget.rest().upper <= budget.tolerance.share;
    return budget;
  };
  const auto& claim = d.explanation.claim;
  if (!d.analysis.alarm.raised && claim.best)  // what restores stability
    name_model(ids_of(claim.best->additions), claim.best->extension->assembly(), claim.best->fit,
               claim.best->additions);
  if (!d.analysis.alarm.raised || (costly && !stands_in)) return finish(std::nullopt);

  const experiment::Experiment cheaper = stands_in ? search->stand_ins.cheaper(measured) : measured;
  const diagnosis::Inquiry inquiry{cheaper, d.request, catalogue, progress};
  const Mixer mixer(inquiry, analysis, subject ? &*subject : nullptr);
  const bool settled = is_settled(d, search);
  std::vector<discovery::KindPointer> kinds;
  const bool fibres = search != nullptr && search->best && search->best->has_fibres();
  if (subject && !settled) kinds = kinds_for(d, analysis.evidence, *subject, fibres);
  Field field{inquiry, analysis, mixer, size, leads_of(analysis, subject ? &*subject : nullptr, kinds)};
  if (!stands_in) field.known = claim.rivals;
  if (settled) {
    std::optional<Mixture> fitted;
    if (d.explanation.verdict == Verdict::discovered)
      fitted = mixer.mixture_of(*search->best);
    else if (claim.best && !stands_in)
      fitted = mixer.mixture_of(*claim.best);
    if (fitted) budget.steps = steps_of(field, *fitted);
    return finish(std::move(fitted));
  }
  inquiry.report("what takes how much", 0.96);
  Entrants entrants = entrants_of(field);
  budget.rough = entrants.rough;
  budget.unlisted_probability = entrants.unlisted_probability;
  for (const Entrant& one : entrants.all)
    budget.contenders.push_back({one.id, one.sort, one.place, one.group, one.term, one.in_the_energy, one.share,
                                 one.probability, one.rest, one.belief,
                                 static_cast<std::size_t>(one.columns.added.cols())});
  for (const diagnosis::FileCause& one : d.explanation.file.causes) {
    const diagnosis::Fit& base = analysis.evidence.fit;
    const double share = 1 - size.squares(one.squares, base) / std::max(size.squares(base), 1e-300);
    // An exact transform has no parameter, so that as much as a cause takes is enough. One with an amplitude does what
    // an error of the rig does as well.
    const double worth = share - (one.amplitudes.empty() ? 0 : ahead);
    if (worth > budget.of_file.worth) budget.of_file = {one.sentence, one.mend, share, worth};
  }
  if (subject && diagnosis::is_isotropic(analysis.evidence.base->models().model(0)))
    budget.anisotropy = search != nullptr && !search->anisotropy.empty()
                            ? search->anisotropy
                            : diagnosis::anisotropy_words(analysis.evidence, budget.tolerance.share);
  Steps steps = steps_of(field, entrants, budget.tolerance.share);
  budget.steps = std::move(steps.all);
  return finish(std::move(steps.fitted));
}

}  // namespace tunica::budget
