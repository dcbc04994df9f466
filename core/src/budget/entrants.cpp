// SPDX-License-Identifier: Apache-2.0
#include "budget/entrants.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <tbb/parallel_for.h>

#include "assembly/memory.hpp"
#include "diagnosis/hypotheses/amplitude_range.hpp"
#include "diagnosis/hypotheses/places.hpp"
#include "diagnosis/naming/singles.hpp"
#include "discovery/set_fit.hpp"
#include "tunica/error.hpp"

namespace tunica::budget {
namespace {

using diagnosis::Variable;

constexpr std::size_t most_entrants = 18;  ///< that are fitted
constexpr std::size_t laws_of_an_invariant = 3;
constexpr std::array<unsigned, 3> degrees{6, 10, 14};
constexpr double as_rough_as_noise = 1.5;  ///< of |r|²/ν
constexpr double unbelieved = 20;          ///< odds against an implausible amplitude
constexpr double rough_share = 0.15;       ///< of the misfit
constexpr double nearly_as_much = 0.25;    ///< of the score: the second place of a mechanism may be the right one
const double of_uniform = 1 / std::sqrt(2 * std::numbers::pi);

/// √Σ(y/σ)²: how many standard deviations all that was measured comes to.
double measured_in_sigmas(const diagnosis::Evidence& evidence) {
  double sum = 0;
  for (const auto& view : evidence.base->layout().channels) {
    if (std::none_of(view.fitted.begin(), view.fitted.end(), [](bool fitted) { return fitted; })) continue;
    const std::vector<double> sigma = diagnosis::row_deviations(view);
    std::size_t k = 0;
    for (std::size_t row = 0; row < view.count; ++row)
      if (view.fitted[row] && k < sigma.size()) sum += std::pow(view.measured[row] / sigma[k++], 2);
  }
  return std::max(std::sqrt(sum), 10.0);
}

double width_of(const assembly::FreeParameter& parameter, double value) {
  return parameter.scale == Scale::log ? value * std::log(parameter.max / parameter.min)
                                       : parameter.max - parameter.min;
}

/// The base with one test by itself: its residuals, and how they change with the parameters of that test alone.
struct Apart {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd base, own;
  std::vector<double> widths;
};
std::optional<Apart> apart(const diagnosis::Evidence& evidence, const std::string& test) {
  const assembly::Assembly& base = *evidence.base;
  const auto variables = diagnosis::all_variables(base);
  std::vector<bool> inside(static_cast<std::size_t>(evidence.fit.residuals.size()), false);
  Eigen::Index rows = 0;
  for (const diagnosis::Curve& curve : evidence.curves)
    if (curve.test == test) {
      for (Eigen::Index i = curve.first; i < curve.first + curve.count; ++i) inside[static_cast<std::size_t>(i)] = true;
      rows += curve.count;
    }
  if (rows <= static_cast<Eigen::Index>(variables.size()) || rows == evidence.fit.residuals.size()) return std::nullopt;
  std::vector<bool> outside = inside;
  outside.flip();
  const auto workspace = base.evaluator().make_workspace();
  const auto fit = [&](const std::vector<bool>& counted) {
    return diagnosis::least_squares(base, variables, evidence.fit.free, *workspace, 60,
                                    {.counted = &counted, .negligible = diagnosis::says_nothing});
  };
  const diagnosis::Fit one = fit(inside), others = fit(outside);
  if (!one.status.ok() || !others.status.ok()) return std::nullopt;
  Apart found{others.residuals + one.residuals, others.jacobian + one.jacobian, one.jacobian, {}};
  const auto& parameters = base.layout().parameters;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const double width = one.at_bound[j] ? 0 : width_of(parameters[j], one.free[j]);
    found.own.col(static_cast<Eigen::Index>(j)) *= width * of_uniform;
  }
  return found;
}

/// Like which invariant of a term it looks what a mechanism or a power of the stretches does to the energy; its own
/// sort where it looks like none. Diagonal fibres whose angle lies along an axis are those of the axis.
void sort_by_form(const diagnosis::Evidence& evidence, std::vector<Entrant>& entrants) {
  constexpr double alike = 0.9, as_much = 0.15;  // as_much: of the misfit
  const auto change = [&](const Entrant& one) -> Eigen::VectorXd { return evidence.fit.residuals - one.residuals; };
  const auto take_sort = [&](Entrant& one, const auto& could_be) {
    double best = alike;
    for (const Entrant& term : entrants) {
      if (&term == &one || !could_be(term) || std::abs(term.share - one.share) > as_much) continue;
      const Eigen::VectorXd a = change(one), b = change(term);
      const double c = a.dot(b) / std::max(a.norm() * b.norm(), 1e-300);
      if (c > best) {
        best = c;
        one.sort = term.sort;
      }
    }
  };
  for (Entrant& one : entrants)
    if (one.diagonal()) take_sort(one, [](const Entrant& term) { return term.fibres() && !term.diagonal(); });
  for (Entrant& one : entrants)
    if (one.in_the_energy && (!one.term || one.powers()))
      take_sort(one, [](const Entrant& term) { return term.term && !term.powers(); });
}

}  // namespace

std::vector<Lead> leads_of(const diagnosis::Analysis& analysis, const discovery::Subject* subject,
                           const std::vector<discovery::KindPointer>& kinds) {
  const diagnosis::Hypotheses& hypotheses = analysis.hypotheses;
  std::vector<Lead> leads;
  const double half = kinds.empty() ? 0 : std::log(0.5);
  // Mechanisms that cannot act here take no share of the prior.
  const auto looked_for = std::count_if(hypotheses.candidates.begin(), hypotheses.candidates.end(),
                                        [](const diagnosis::Candidate& one) { return !one.hypotheses.empty(); });
  const double each = -std::log(std::max<double>(1, static_cast<double>(looked_for)));
  for (const diagnosis::Direction& direction : hypotheses.directions) {
    const diagnosis::Hypothesis& hypothesis = hypotheses.hypothesis(direction);
    if (hypothesis.mechanism->stage == Stage::data && !direction.row && diagnosis::takes(*hypothesis.mechanism, "rows"))
      continue;
    leads.push_back({{hypothesis.addition, nullptr},
                     hypothesis.signature,
                     direction.side,
                     direction.sign,
                     {},
                     half + each + std::log(direction.share)});
  }
  const diagnosis::Evidence& evidence = analysis.evidence;
  std::vector<std::vector<Lead>> of_kinds(kinds.size());
  tbb::parallel_for(std::size_t{0}, kinds.size(), [&](std::size_t k) {
    const discovery::KindPointer& kind = kinds[k];
    try {
      const discovery::BoundSet set(*subject, {kind});
      const discovery::BoundTerm& term = set.terms().front();
      const auto& parameters = set.assembly().layout().parameters;
      const auto workspace = set.assembly().evaluator().make_workspace();
      std::vector<double> at(parameters.size());
      for (std::size_t j = 0; j < at.size(); ++j) {
        at[j] = parameters[j].initial;
        const auto& known = evidence.base->layout().parameters;
        for (std::size_t i = 0; i < known.size(); ++i)
          if (known[i].name == parameters[j].name) at[j] = evidence.fit.free[i];
      }
      const auto combinations = discovery::combinations(*kind);
      for (const auto& shapes : combinations) {
        at[term.amplitude] = kind->negative ? -1e-4 * std::abs(parameters[term.amplitude].min)
                                            : std::max(parameters[term.amplitude].min, 0.0);
        for (std::size_t s = 0; s < shapes.size(); ++s) at[term.shapes[s]] = shapes[s];
        Eigen::VectorXd r;
        Eigen::MatrixXd J;
        if (!diagnosis::whitened(set.assembly(), at, *workspace, r, &J).ok() || !J.allFinite()) continue;
        const double sign = kind->negative ? -1 : 1;
        of_kinds[k].push_back({{std::nullopt, kind},
                               sign * J.col(static_cast<Eigen::Index>(term.amplitude)),
                               MechanismFactory::Side::positive,
                               sign,
                               shapes,
                               half + kind->log_prior - std::log(static_cast<double>(combinations.size()))});
      }
    } catch (const InputError&) {  // the term cannot act there
    }
  });
  for (auto& of_kind : of_kinds)
    for (Lead& lead : of_kind) leads.push_back(std::move(lead));
  return leads;
}

std::vector<const Lead*> promising(const Field& field, const Mixture& mixture, std::size_t count, std::size_t laws,
                                   bool second_places) {
  const diagnosis::Projection projection(diagnosis::interior(mixture.fit));
  std::vector<std::pair<double, const Lead*>> ranking;
  for (const Lead& lead : field.leads) {
    const auto same = std::count_if(mixture.members.begin(), mixture.members.end(),
                                    [&](const Member& member) { return member.key() == lead.member.key(); });
    const bool again = lead.member.mechanism && field.inquiry.mechanism(lead.member.mechanism->id).several;
    if (same > 0 && !again) continue;
    const Eigen::VectorXd left = projection.off(lead.signature);
    const double length = left.norm();
    if (!(length > diagnosis::invisible * lead.signature.norm())) continue;
    const double t = -left.dot(mixture.fit.residuals) / length;
    if (lead.side == MechanismFactory::Side::both || t > 0) ranking.emplace_back(t * t, &lead);
  }
  std::stable_sort(ranking.begin(), ranking.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<const Lead*> chosen, elsewhere;
  std::map<std::string, std::pair<double, const Lead*>> seen;
  std::set<std::string> twice;
  std::map<std::string, std::size_t> of_invariant;
  for (const auto& [T, lead] : ranking) {
    const discovery::KindPointer& term = lead->member.term;
    const auto first = seen.find(lead->member.key());
    if (first != seen.end()) {
      const auto& [most, other] = first->second;
      const bool nearly = second_places && !term && !lead->member.mechanism->place.row && T >= nearly_as_much * most;
      if (nearly && !(lead->member.mechanism->place == other->member.mechanism->place) &&
          twice.insert(first->first).second)
        elsewhere.push_back(lead);
      continue;
    }
    if (chosen.size() >= count || (term && of_invariant[term->invariant_words()] >= laws)) continue;
    seen.emplace(lead->member.key(), std::pair(T, lead));
    if (term) ++of_invariant[term->invariant_words()];
    chosen.push_back(lead);
  }
  chosen.insert(chosen.end(), elsewhere.begin(), elsewhere.end());
  return chosen;
}

Columns columns_of(const Field& field, const Mixture& mixture) {
  const diagnosis::Evidence& evidence = field.analysis.evidence;
  if (!mixture.extension) return {diagnosis::interior(mixture.fit), Eigen::MatrixXd(mixture.fit.residuals.size(), 0)};
  const auto variables = mixture.extension->variables();
  const auto& parameters = mixture.extension->assembly().layout().parameters;
  const double of_amplitude = std::log(measured_in_sigmas(evidence));
  std::map<Variable, double> width;
  for (std::size_t m = 0; m < mixture.members.size(); ++m)
    for (std::size_t v = 0; v < mixture.own[m].size(); ++v) {
      const Variable& variable = mixture.own[m][v];
      const double value = mixture.fit.free[variable.front()];
      double wide = width_of(parameters[variable.front()], value);
      if (v == 0 && mixture.members[m].mechanism) {
        const diagnosis::Addition& addition = *mixture.members[m].mechanism;
        const auto range = diagnosis::range_of(field.inquiry.mechanism(addition.id), addition);
        wide = range.plausible_max - range.plausible_min;
      } else if (v == 0) {
        wide = std::abs(value) * of_amplitude;
      }
      width[variable] = wide;
    }
  std::vector<Eigen::Index> base;
  std::vector<std::pair<Eigen::Index, double>> added;
  for (std::size_t k = 0; k < variables.size(); ++k) {
    if (mixture.fit.at_bound[k]) continue;
    const auto own = width.find(variables[k]);
    if (own == width.end())
      base.push_back(static_cast<Eigen::Index>(k));
    else
      added.emplace_back(static_cast<Eigen::Index>(k), own->second);
  }
  Eigen::MatrixXd columns(mixture.fit.residuals.size(), static_cast<Eigen::Index>(added.size()));
  for (std::size_t k = 0; k < added.size(); ++k)
    columns.col(static_cast<Eigen::Index>(k)) =
        mixture.fit.jacobian.col(added[k].first) * (added[k].second * of_uniform);
  return {mixture.fit.jacobian(Eigen::all, base), std::move(columns)};
}

double log_evidence(const Field& field, const Mixture& mixture) {
  const Columns columns = columns_of(field, mixture);
  return field.unlisted->log_evidence(mixture.fit.residuals, columns.base, columns.added);
}

Belief belief_of(const Field& field, const Mixture& mixture, std::size_t member) {
  constexpr double half_again = 1.5;
  const Variable& amplitude = mixture.own[member].front();
  const auto variables = mixture.extension->variables();
  const auto at = std::find(variables.begin(), variables.end(), amplitude) - variables.begin();
  const bool at_bound = mixture.fit.at_bound[static_cast<std::size_t>(at)];
  if (at_bound) return Belief::beyond;
  if (!mixture.members[member].mechanism) return Belief::plausible;
  const diagnosis::Addition& addition = *mixture.members[member].mechanism;
  const MechanismFactory& mechanism = field.inquiry.mechanism(addition.id);
  const auto range = diagnosis::range_of(mechanism, addition);
  const double value = mixture.fit.free[amplitude.front()] - mechanism.null;
  const double low = range.plausible_min - mechanism.null, high = range.plausible_max - mechanism.null;
  if (value >= low && value <= high) return Belief::plausible;
  return value < half_again * low || value > half_again * high ? Belief::beyond : Belief::flagged;
}

Entrants entrants_of(Field& field) {
  const diagnosis::Evidence& evidence = field.analysis.evidence;
  const Mixture base = field.mixer.base();
  const double misfit = std::max(field.size.squares(base.fit), 1e-300);
  const auto chosen = promising(field, base, most_entrants, laws_of_an_invariant, true);
  std::vector<std::optional<Entrant>> fitted(chosen.size());
  tbb::parallel_for(std::size_t{0}, chosen.size(), [&](std::size_t k) {
    auto mixture = field.mixer.grown(base, *chosen[k]);
    if (!mixture) return;
    for (const diagnosis::Refit& refit : field.known)
      if (refit.additions.size() == 1 && chosen[k]->member.mechanism &&
          refit.additions.front().id == chosen[k]->member.mechanism->id &&
          refit.additions.front().place == chosen[k]->member.mechanism->place && refit.fit.chi2 < mixture->fit.chi2 &&
          refit.fit.jacobian.cols() == mixture->fit.jacobian.cols())
        mixture = field.mixer.mixture_of(refit);
    Entrant entrant;
    const Member& member = mixture->members.front();
    entrant.id = entrant.sort = member.words();
    entrant.term = !member.mechanism;
    entrant.in_the_energy = entrant.term;
    if (member.mechanism) {
      const MechanismFactory& mechanism = field.inquiry.mechanism(member.mechanism->id);
      entrant.place = member.mechanism->place;
      entrant.group = diagnosis::group_of(mechanism);
      entrant.in_the_energy = entrant.group == diagnosis::CauseGroup::material && !assembly::has_memory(mechanism) &&
                              entrant.place.tests.empty();
    } else {
      entrant.sort = member.term->invariant_words();
    }
    entrant.share = 1 - field.size.squares(mixture->fit) / misfit;
    entrant.rest = field.size.of(mixture->fit);
    entrant.belief = belief_of(field, *mixture, 0);
    entrant.residuals = mixture->fit.residuals;
    entrant.columns = columns_of(field, *mixture);
    entrant.log_prior = chosen[k]->log_prior - (entrant.belief == Belief::beyond ? std::log(unbelieved) : 0);
    entrant.mixture = std::move(mixture);
    fitted[k] = std::move(entrant);
  });
  Entrants found;
  for (auto& one : fitted)
    if (one) found.all.push_back(std::move(*one));

  std::set<std::string> tests;
  for (const diagnosis::Curve& curve : evidence.curves) tests.insert(curve.test);
  const diagnosis::Request& request = field.inquiry.request;
  const bool states = request.mechanisms.empty() && request.considers(diagnosis::code_of(Entrant().group));
  if (tests.size() > 1 && states && !evidence.base->layout().has_costly_tests)
    for (const std::string& test : tests) {
      auto alone = apart(evidence, test);
      if (!alone) continue;
      Entrant entrant;
      entrant.id = entrant.sort = "another_state";
      entrant.place.tests = {test};
      diagnosis::Fit fit = evidence.fit;
      fit.residuals = alone->residuals;
      fit.chi2 = fit.residuals.squaredNorm();
      entrant.share = 1 - field.size.squares(fit) / misfit;
      entrant.rest = field.size.of(fit);
      entrant.residuals = fit.residuals;
      entrant.columns = {std::move(alone->base), std::move(alone->own)};
      entrant.log_prior = std::log(0.1 / static_cast<double>(tests.size()));
      found.all.push_back(std::move(entrant));
    }
  sort_by_form(evidence, found.all);

  const auto least = std::min_element(found.all.begin(), found.all.end(), [](const Entrant& a, const Entrant& b) {
    return a.residuals.squaredNorm() < b.residuals.squaredNorm();
  });
  const Eigen::VectorXd& left = least == found.all.end() ? base.fit.residuals : least->residuals;
  for (const unsigned degree : degrees) {
    field.unlisted = std::make_shared<const UnlistedMisfit>(evidence, degree);
    const UnlistedMisfit::Rough rough = field.unlisted->rough(left);
    if (rough.squares < as_rough_as_noise * rough.expected) {
      found.rough = false;
      break;
    }
    found.rough = rough.squares - rough.expected > rough_share * misfit;
    // Rough as it is, it is little: noise that large explains it.
    if (degree == degrees.back())
      field.unlisted =
          std::make_shared<const UnlistedMisfit>(evidence, degree, std::sqrt(rough.squares / rough.expected));
  }
  tbb::parallel_for(std::size_t{0}, found.all.size(), [&](std::size_t k) {
    Entrant& one = found.all[k];
    one.log_evidence = field.unlisted->log_evidence(one.residuals, one.columns.base, one.columns.added) + one.log_prior;
  });
  // No listed cause is as likely before the data as all of them.
  std::vector<double> logs{log_evidence(field, base)};
  for (const Entrant& one : found.all) logs.push_back(one.log_evidence);
  const double all = diagnosis::log_sum(logs);
  found.unlisted_probability = std::exp(logs.front() - all);
  for (Entrant& one : found.all) one.probability = std::exp(one.log_evidence - all);
  std::stable_sort(found.all.begin(), found.all.end(), [](const Entrant& a, const Entrant& b) {
    // A mechanism and a term may be the same: rounding does not order them.
    const double more = std::round(1e6 * a.share), less = std::round(1e6 * b.share);
    return more != less ? more > less : a.id < b.id;
  });
  return found;
}

}  // namespace tunica::budget
