// SPDX-License-Identifier: Apache-2.0
#include "discovery/common/common_discovery.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "diagnosis/evidence/anisotropy.hpp"
#include "diagnosis/evidence/base_fit.hpp"
#include "diagnosis/naming/remainder.hpp"
#include "discovery/common/common_rivals.hpp"
#include "discovery/common/common_verdict.hpp"
#include "discovery/preparation.hpp"
#include "discovery/remainder.hpp"
#include "discovery/search.hpp"
#include "numerics/distributions.hpp"
#include "tunica/error.hpp"

namespace tunica::discovery {
namespace {

/// A specimen while it is searched. Its experiment stays where it is: the analysis refers to it.
struct Searching {
  std::string id;
  std::unique_ptr<experiment::Experiment> measured;
  diagnosis::Analysis analysis;
};

diagnosis::Inquiry inquiry_of(const Searching& one, const diagnosis::Request& request,
                              const plugins::Catalogue& catalogue) {
  static const diagnosis::Progress silent;
  return {*one.measured, request, catalogue, silent};
}

bool is_clean(const std::vector<Searching>& specimens, const CommonFit& fit) {
  std::vector<double> p_values;
  for (std::size_t s = 0; s < specimens.size(); ++s)
    p_values.push_back(p_of_rest(specimens[s].analysis, fit.specimens[s].fit));
  return diagnosis::is_clean(p_of_rests(p_values));
}

struct CommonSearch {
  std::vector<std::shared_ptr<const Subject>> subjects;
  std::vector<std::unique_ptr<const Fitter>> fitters;
  std::unique_ptr<const CommonFitter> fitter;
  std::vector<CommonFit> sets;  ///< likeliest first
};

/// Fibres of an isotropic base are tried where its terms leave more than noise and the data show two directions.
CommonSearch search_in(const std::vector<Searching>& specimens, const Request& request,
                       const plugins::Catalogue& catalogue, bool has_directions, const std::vector<CommonFit>& before) {
  CommonSearch found;
  std::vector<States> states;
  std::vector<const Fitter*> fitters;
  for (const Searching& one : specimens) {
    const diagnosis::Evidence& evidence = one.analysis.evidence;
    found.subjects.push_back(std::make_shared<const Subject>(
        Subject{evidence.experiment, evidence.run, request.model, request.from_nothing, catalogue}));
    states.push_back(reached_states(*found.subjects.back(), evidence.fit.free));
    found.fitters.push_back(std::make_unique<const Fitter>(*found.subjects.back(), evidence));
    fitters.push_back(found.fitters.back().get());
  }
  const auto over = [&](bool directions) {
    std::vector<std::vector<KindPointer>> kinds;
    for (std::size_t s = 0; s < specimens.size(); ++s)
      kinds.push_back(scaled_kinds(
          *found.fitters[s],
          kinds_of(request, states[s], directions, sees_volume(*found.subjects[s], specimens[s].analysis.evidence))));
    found.fitter = std::make_unique<const CommonFitter>(fitters, kinds, request.from_nothing);
    return search(*found.fitter, {request.term_limit(), request.most_parameters, &before},
                  [&](const CommonFit& set) { return is_clean(specimens, set); });
  };
  found.sets = over(has_directions);
  const bool clean = !found.sets.empty() && is_clean(specimens, found.sets.front());
  if (!has_directions && !clean && request.invariants.empty() &&
      std::any_of(specimens.begin(), specimens.end(),
                  [](const Searching& one) { return !diagnosis::anisotropy_words(one.analysis.evidence).empty(); })) {
    std::vector<CommonFit> with_fibres = over(true);
    if (!with_fibres.empty() &&
        (found.sets.empty() || with_fibres.front().log_evidence > found.sets.front().log_evidence))
      found.sets = std::move(with_fibres);
  }
  if (!found.sets.empty()) simplest_first(found.sets, [&](const CommonFit& set) { return is_clean(specimens, set); });
  return found;
}

/// Each specimen by itself, up to whether anything is wrong.
std::vector<Searching> analysed(const std::vector<Member>& members, const Request& request,
                                const diagnosis::Request& of_analysis, const plugins::Catalogue& catalogue,
                                const diagnosis::Progress& progress, CommonDiscovery& found) {
  std::vector<Searching> specimens;
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (progress)
      progress(fmt::format("specimen {} of {}", k + 1, members.size()),
               0.5 * static_cast<double>(k) / static_cast<double>(members.size()));
    experiment::Experiment given = members[k].experiment;
    if (request.from_nothing) given = with_first_terms(std::move(given), request.model, false, *catalogue.term_model());
    Searching one{members[k].id, nullptr, {}};
    try {
      one.measured = std::make_unique<experiment::Experiment>(experiment::measured_only(std::move(given)));
      const diagnosis::Inquiry inquiry = inquiry_of(one, of_analysis, catalogue);
      one.analysis = request.from_nothing ? diagnosis::analyse(inquiry, {}) : screened(inquiry);
      specimens.push_back(std::move(one));
    } catch (const InputError& problem) {
      found.left_out.push_back({one.id, problem.what()});
    } catch (const diagnosis::BaseFitFailure& problem) {
      found.left_out.push_back({one.id, problem.what()});
    }
  }
  if (specimens.empty())
    throw InputError(fmt::format(
        "discovery: none of {} specimens can be fitted; the first, '{}': {}. Run `tunica check` on the experiment, "
        "which shows what fails; where a test starts a program, add --run-external",
        found.left_out.size(), found.left_out.front().id, found.left_out.front().reason));
  return specimens;
}

/// The noise of every specimen that the terms restate, if that of any one changes.
bool restate(std::vector<Searching>& specimens, const diagnosis::Request& request, const plugins::Catalogue& catalogue,
             const CommonFit& best) {
  bool changed = false;
  for (std::size_t s = 0; s < specimens.size(); ++s) {
    const auto inquiry = inquiry_of(specimens[s], request, catalogue);
    if (auto again = diagnosis::restated(inquiry, specimens[s].analysis, best.specimens[s].fit)) {
      specimens[s].analysis = std::move(*again);
      changed = true;
    }
  }
  return changed;
}

/// −2 Σ ln p ~ χ²(2n) (R. A. Fisher, Statistical Methods for Research Workers, 1932, § 21.1).
double p_of_alarms(const std::vector<Searching>& specimens) {
  constexpr double least = 1e-12;  // no calibration says more
  double sum = 0;
  for (const Searching& one : specimens) sum -= 2 * std::log(std::clamp(one.analysis.alarm.p(), least, 1.0));
  return sum > 0 ? numerics::chi_squared_above(sum, 2 * static_cast<double>(specimens.size())) : 1;
}

/// One warning of a kind, and how many specimens have it.
std::vector<diagnosis::Warning> gathered(const std::vector<Searching>& specimens) {
  std::map<diagnosis::WarningKind, std::pair<diagnosis::Warning, std::size_t>> by_kind;
  for (const Searching& one : specimens) {
    const diagnosis::Evidence& evidence = one.analysis.evidence;
    std::map<diagnosis::WarningKind, const diagnosis::Warning*> own;
    for (const auto* list : {&evidence.warnings, &evidence.noise_warnings})
      for (const diagnosis::Warning& warning : *list) own.emplace(warning.kind, &warning);
    for (const auto& [kind, warning] : own) {
      diagnosis::Warning first = *warning;
      first.text = fmt::format("{}: {}", one.id, first.text);
      ++by_kind.emplace(kind, std::pair{std::move(first), 0}).first->second.second;
    }
  }
  std::vector<diagnosis::Warning> warnings;
  for (auto& [kind, found] : by_kind) {
    if (found.second > 1)
      found.first.text += fmt::format(" (of this kind in {} of {} specimens)", found.second, specimens.size());
    warnings.push_back(std::move(found.first));
  }
  return warnings;
}

}  // namespace

std::size_t CommonTerm::seen() const {
  return static_cast<std::size_t>(
      std::count_if(specimens.begin(), specimens.end(), [](const auto& one) { return one.has_value(); }));
}

double p_of_rests(const std::vector<double>& p_values) {
  // The smaller one of two tests at 1 in 40 each.
  constexpr double level = 0.025;
  if (p_values.size() == 1) return p_values.front();
  const auto left = std::count_if(p_values.begin(), p_values.end(), [](double p) { return p <= level; });
  return numerics::binomial_at_least(static_cast<std::size_t>(left), p_values.size(), 2 * level);
}

CommonDiscovery discover_together(const std::vector<Member>& members, const Request& request,
                                  const plugins::Catalogue& catalogue, const diagnosis::Progress& progress) {
  check(request, catalogue);
  for (const Member& member : members) check_states(request, member.experiment);
  if (members.empty())
    throw InputError("discovery: there is no specimen to search in. Give the table one row at least");
  CommonDiscovery found{request};
  const diagnosis::Request of_analysis = analysis_request(request);
  check_volume(request, members.front().experiment, catalogue);
  const bool directions = has_directions(members.front().experiment, request.model, catalogue);
  std::vector<Searching> specimens = analysed(members, request, of_analysis, catalogue, progress, found);
  found.p_before = p_of_alarms(specimens);
  const bool search_pays = request.from_nothing || found.p_before <= request.alpha;
  CommonSearch searched;
  if (search_pays) {
    if (progress) progress("terms of the energy", 0.5);
    searched = search_in(specimens, request, catalogue, directions, {});
    if (!searched.sets.empty() && restate(specimens, of_analysis, catalogue, searched.sets.front())) {
      found.p_before = p_of_alarms(specimens);
      searched = search_in(specimens, request, catalogue, directions, searched.sets);
    }
    if (progress) progress("mechanisms as rivals", 0.8);
    if (!request.from_nothing) {
      std::vector<std::vector<Rival>> rivals;
      for (const Searching& one : specimens)
        rivals.push_back(rivals_of(inquiry_of(one, of_analysis, catalogue), one.analysis));
      found.rivals = common_rivals(rivals, searched.fitter->root());
    }
  }
  found.sets_tried = searched.sets.size();
  found.warnings = gathered(specimens);
  for (std::size_t s = 0; s < specimens.size(); ++s) {
    SpecimenOutcome one{specimens[s].id, std::move(specimens[s].analysis),
                        search_pays ? searched.subjects[s] : nullptr};
    one.chi2_before = one.chi2_after = one.analysis.evidence.fit.chi2;
    one.p_after = one.analysis.alarm.p();
    found.rows += static_cast<std::size_t>(one.analysis.evidence.fit.residuals.size());
    found.chi2_before += one.chi2_before;
    found.specimens.push_back(std::move(one));
  }
  found.chi2_after = found.chi2_before;
  found.p_after = found.p_before;
  if (search_pays)
    settle(found, *searched.fitter, std::move(searched.sets));
  else
    say_nothing_is_missing(found);
  if (progress) progress("done", 1);
  return found;
}

}  // namespace tunica::discovery
