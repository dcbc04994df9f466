// SPDX-License-Identifier: Apache-2.0
#include "budget/mixture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/orthogonal.hpp"
#include "tunica/error.hpp"

namespace tunica::budget {
namespace {

using diagnosis::Variable;

std::vector<std::string> names_of(const assembly::Assembly& assembly) {
  std::vector<std::string> names;
  for (const auto& parameter : assembly.layout().parameters) names.push_back(parameter.name);
  return names;
}

/// Values of parameters of the same name, within their bounds.
void take_over(const Mixture& from, const assembly::Assembly& onto, std::vector<double>& start) {
  const auto& parameters = onto.layout().parameters;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const auto same = std::find(from.names.begin(), from.names.end(), parameters[j].name);
    if (same != from.names.end())
      start[j] = std::clamp(from.fit.free[static_cast<std::size_t>(same - from.names.begin())], parameters[j].min,
                            parameters[j].max);
  }
}

std::vector<Variable> variables_of(const Mixture& mixture, const diagnosis::Analysis& analysis) {
  return mixture.extension ? mixture.extension->variables() : diagnosis::all_variables(*analysis.evidence.base);
}

}  // namespace

std::string Member::words() const { return term ? discovery::words_of({term}) : mechanism->id; }

Mixture Mixer::base() const {
  Mixture mixture;
  mixture.names = names_of(*analysis_.evidence.base);
  mixture.fit = analysis_.evidence.fit;
  return mixture;
}

Mixture Mixer::mixture_of(const diagnosis::Refit& refit) const {
  Mixture mixture;
  mixture.extension = refit.extension;
  mixture.names = names_of(refit.extension->assembly());
  mixture.fit = refit.fit;
  for (std::size_t k = 0; k < refit.additions.size(); ++k) {
    mixture.members.push_back({refit.additions[k], nullptr});
    const diagnosis::Extension::Part& part = refit.extension->parts()[k];
    auto& own = mixture.own.emplace_back();
    own.push_back(part.amplitude);
    own.insert(own.end(), part.nuisance.begin(), part.nuisance.end());
  }
  return mixture;
}

std::optional<Mixture> Mixer::mixture_of(const discovery::SetFit& found) const {
  std::vector<Member> members;
  for (const discovery::KindPointer& kind : found.kinds) members.push_back({{}, kind});
  return again({std::move(members), nullptr, names_of(found.set->assembly()), found.fit, {}});
}

std::optional<Mixture> Mixer::again(const Mixture& other) const {
  auto mixture = bound(other.members);
  if (!mixture) return std::nullopt;
  const assembly::Assembly& assembly = mixture->extension->assembly();
  std::vector<double> start;
  for (const auto& parameter : assembly.layout().parameters) start.push_back(parameter.initial);
  take_over(other, assembly, start);
  fit(*mixture, start);
  if (mixture->fit.residuals.size() == 0) return std::nullopt;
  return mixture;
}

std::optional<Mixture> Mixer::bound(std::vector<Member> members) const {
  const diagnosis::Evidence& evidence = analysis_.evidence;
  std::vector<discovery::KindPointer> kinds;
  std::vector<diagnosis::Addition> additions;
  for (const Member& member : members)
    if (member.term)
      kinds.push_back(member.term);
    else
      additions.push_back(*member.mechanism);
  Mixture mixture;
  try {
    std::optional<discovery::BoundSet> terms;
    if (!kinds.empty()) terms.emplace(*subject_, kinds);
    mixture.extension = std::make_shared<const diagnosis::Extension>(
        terms ? terms->experiment() : evidence.experiment, evidence.run, std::move(additions), inquiry_.catalogue);
    mixture.names = names_of(mixture.extension->assembly());
    std::size_t part = 0, term = 0;
    for (const Member& member : members) {
      auto& own = mixture.own.emplace_back();
      if (member.mechanism) {
        const diagnosis::Extension::Part& one = mixture.extension->parts()[part++];
        own.push_back(one.amplitude);
        own.insert(own.end(), one.nuisance.begin(), one.nuisance.end());
        continue;
      }
      const std::string& added = terms->terms()[term++].name;
      const auto add = [&](const std::string& name) {
        own.push_back({discovery::index_of(mixture.extension->assembly(), *subject_, added, name)});
      };
      add(member.term->amplitude());
      for (const discovery::Shape& shape : member.term->shapes) add(shape.name);
    }
  } catch (const InputError&) {
    return std::nullopt;
  }
  mixture.members = std::move(members);
  return mixture;
}

void Mixer::fit(Mixture& mixture, const std::vector<double>& start) const {
  const assembly::Assembly& assembly = mixture.extension->assembly();
  const auto workspace = assembly.evaluator().make_workspace();
  diagnosis::Fit fit = diagnosis::least_squares(assembly, mixture.extension->variables(), start, *workspace, 60,
                                                {.negligible = diagnosis::says_nothing});
  if (!fit.status.ok()) return;
  if (mixture.fit.residuals.size() == 0 || fit.chi2 < mixture.fit.chi2) mixture.fit = std::move(fit);
}

std::optional<Mixture> Mixer::grown(const Mixture& from, const Lead& lead) const {
  std::vector<Member> members = from.members;
  members.push_back(lead.member);
  auto grown = bound(std::move(members));
  if (!grown) return std::nullopt;
  const assembly::Assembly& assembly = grown->extension->assembly();
  const auto& parameters = assembly.layout().parameters;

  const diagnosis::Projection projection(diagnosis::interior(from.fit));
  const Eigen::VectorXd left = projection.off(lead.signature);
  const double length = left.squaredNorm();
  if (!(length > 0)) return std::nullopt;
  double promised = -left.dot(from.fit.residuals) / length;
  if (lead.side != MechanismFactory::Side::both && promised < 0) promised = 0.1 / std::sqrt(length);
  const double score = lead.sign * promised;
  const double amplitude = lead.side == MechanismFactory::Side::even ? std::sqrt(std::abs(score)) : score;

  // What the parameters do when it is added: J Δ = −s a.
  Eigen::MatrixXd scaled = from.fit.jacobian;
  const Eigen::VectorXd lengths = scaled.colwise().norm().cwiseMax(1e-300).transpose();
  for (Eigen::Index c = 0; c < scaled.cols(); ++c) scaled.col(c) /= lengths[c];
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(scaled.cols());
  if (scaled.cols() > 0)
    shift = numerics::least_squares_solution(scaled, -lead.signature * promised, 1e-6).cwiseQuotient(lengths);
  const std::vector<Variable> moved = variables_of(from, analysis_);

  for (const double share : {1.0, 0.3}) {
    std::vector<double> start(parameters.size());
    for (std::size_t j = 0; j < start.size(); ++j) start[j] = parameters[j].initial;
    for (const diagnosis::Extension::Part& part : grown->extension->parts()) {
      for (const std::size_t member : part.amplitude) start[member] = part.null;
      for (std::size_t k = 0; k < part.nuisance.size(); ++k)
        for (const std::size_t member : part.nuisance[k])
          start[member] = std::clamp(part.nuisance_start[k], parameters[member].min, parameters[member].max);
    }
    take_over(from, assembly, start);
    for (std::size_t k = 0; k < moved.size(); ++k)
      for (const std::size_t member : moved[k]) {
        const auto same = std::find(grown->names.begin(), grown->names.end(), from.names[member]);
        if (same == grown->names.end()) continue;
        const auto j = static_cast<std::size_t>(same - grown->names.begin());
        const double step = share * shift[static_cast<Eigen::Index>(k)], width = parameters[j].max - parameters[j].min;
        if (parameters[j].scale == Scale::log)  // as far as the straight line can be believed
          start[j] *= std::exp(std::clamp(step / start[j], -1.0, 1.0));
        else
          start[j] += std::clamp(step, -0.3 * width, 0.3 * width);
        start[j] = std::clamp(start[j], parameters[j].min, parameters[j].max);
      }
    const std::vector<Variable>& own = grown->own.back();
    const double null = lead.member.mechanism ? grown->extension->parts().back().null : 0;
    for (const std::size_t member : own.front())
      start[member] = std::clamp(null + share * amplitude, parameters[member].min, parameters[member].max);
    for (std::size_t k = 0; k < lead.shapes.size(); ++k) start[own[k + 1].front()] = lead.shapes[k];
    fit(*grown, start);
    if (grown->fit.residuals.size() > 0 && grown->fit.chi2 < from.fit.chi2 - 0.7 * promised * promised * length) break;
  }
  if (grown->fit.residuals.size() == 0) return std::nullopt;
  // A base at a bound went there to make up for what it lacks. With the cause, it may belong where it began.
  if (from.members.empty() && diagnosis::at_a_bound(from.fit)) {
    std::vector<double> start(parameters.size());
    for (std::size_t j = 0; j < start.size(); ++j) start[j] = parameters[j].initial;
    for (const Variable& variable : grown->own.back())
      for (const std::size_t member : variable) start[member] = grown->fit.free[member];
    fit(*grown, start);
  }
  return grown;
}

std::optional<Mixture> Mixer::reduced(const Mixture& from, const std::vector<bool>& kept) const {
  std::vector<Member> members;
  for (std::size_t k = 0; k < from.members.size(); ++k)
    if (kept[k]) members.push_back(from.members[k]);
  if (members.empty()) return base();
  auto reduced = bound(std::move(members));
  if (!reduced) return std::nullopt;
  const auto& parameters = reduced->extension->assembly().layout().parameters;
  // Names may differ where one of several is left out: what a member brings is taken over by its place.
  std::vector<double> start(parameters.size());
  for (std::size_t j = 0; j < start.size(); ++j) start[j] = parameters[j].initial;
  take_over(from, reduced->extension->assembly(), start);
  for (std::size_t k = 0, at = 0; k < from.members.size(); ++k) {
    if (!kept[k]) continue;
    for (std::size_t v = 0; v < from.own[k].size(); ++v)
      for (std::size_t m = 0; m < from.own[k][v].size(); ++m) {
        const std::size_t j = reduced->own[at][v][m];
        start[j] = std::clamp(from.fit.free[from.own[k][v][m]], parameters[j].min, parameters[j].max);
      }
    ++at;
  }
  fit(*reduced, start);
  // What was left out may have pulled the base far away: the base fit is the other place to begin.
  std::vector<double> again = start;
  take_over(base(), reduced->extension->assembly(), again);
  fit(*reduced, again);
  if (reduced->fit.residuals.size() == 0) return std::nullopt;
  return reduced;
}

}  // namespace tunica::budget
