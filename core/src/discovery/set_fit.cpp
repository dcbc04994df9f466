// SPDX-License-Identifier: Apache-2.0
#include "discovery/set_fit.hpp"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "numerics/eigenpairs.hpp"
#include "numerics/orthogonal.hpp"
#include "tunica/error.hpp"

namespace tunica::discovery {
namespace {

using diagnosis::Fit;
using diagnosis::Projection;

constexpr double idle = 0.5;         ///< effect of a term in σ below which it does nothing
constexpr double as_promised = 0.7;  ///< of the gain: no second start is tried

/// −L⁻¹y, the whitened residuals r of predictions that are all 0: with p any predictions, r(p; y) + r(p; 2p) = −L⁻¹y.
Eigen::VectorXd residuals_of_nothing(const diagnosis::Evidence& evidence) {
  const assembly::Assembly& base = *evidence.base;
  const auto workspace = base.evaluator().make_workspace();
  std::vector<double> twice(base.layout().prediction_count);
  Eigen::VectorXd mirrored = Eigen::VectorXd::Zero(evidence.fit.residuals.size());
  if (base.evaluator().predict(evidence.fit.free, twice, {}, *workspace).ok()) {
    for (double& value : twice) value *= 2;
    base.evaluator().measure(twice, *workspace);
    (void)diagnosis::whitened(base, evidence.fit.free, *workspace, mirrored, nullptr);
  }
  return evidence.fit.residuals + mirrored;
}

/// A term acts in the direction that its amplitude may go.
Promise promise_of(const Kind& kind, const Projection& absorbed, const Eigen::VectorXd& residuals,
                   Eigen::VectorXd signature) {
  const Eigen::VectorXd left = absorbed.off(signature);
  const double length = left.squaredNorm();
  Promise promise;
  promise.signature = std::move(signature);
  if (!(length > 1e-20 * promise.signature.squaredNorm()) || !std::isfinite(length)) return promise;
  const double amplitude = -left.dot(residuals) / length;
  if (kind.negative ? amplitude >= 0 : amplitude <= 0) return promise;
  promise.amplitude = amplitude;
  promise.gain = amplitude * amplitude * length;
  return promise;
}

/// d value/d coordinate of the search.
double slope(const assembly::FreeParameter& parameter, double value) {
  return parameter.scale == Scale::log ? value * std::log(parameter.max / parameter.min)
                                       : parameter.max - parameter.min;
}

/// Whether the data drive the shape of some law to the end of its range: another law is meant.
bool has_shape_at_bound(const SetFit& fit) {
  for (const BoundTerm& term : fit.set->terms())
    for (const std::size_t shape : term.shapes)
      if (fit.fit.at_bound[shape]) return true;
  return false;
}

/// |r|² above which the evidence cannot come to `worth`.
double wanted_for(double worth) { return std::max(-2 * worth, 0.0); }

}  // namespace

std::vector<std::vector<double>> combinations(const Kind& kind) {
  std::vector<std::vector<double>> all{{}};
  for (const Shape& shape : kind.shapes) {
    std::vector<std::vector<double>> longer;
    for (const auto& one : all)
      for (const double start : shape.starts) {
        longer.push_back(one);
        longer.back().push_back(start);
      }
    all.swap(longer);
  }
  return all;
}

double log_prior(const std::vector<KindPointer>& kinds, bool from_nothing) {
  double sum = 0;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    sum += kinds[k]->log_prior + std::log(static_cast<double>(k + 1));
    if (k > 0) sum += std::log(from_nothing ? 0.5 : 0.1);
  }
  return sum;
}

Fitter::Fitter(const Subject& subject, const diagnosis::Evidence& evidence, Effort effort)
    : subject_(subject), evidence_(evidence), effort_(effort) {
  const Eigen::VectorXd nothing = residuals_of_nothing(evidence);
  measured_ = std::max(nothing.norm(), 10.0);
  if (subject.from_nothing) {
    root_.fit.residuals = nothing;
    root_.fit.chi2 = nothing.squaredNorm();
    root_.fit.jacobian.resize(nothing.size(), 0);
  } else {
    root_.set = std::make_shared<const BoundSet>(subject, std::vector<KindPointer>{});
    root_.fit = evidence.fit;
  }
  root_.log_evidence = log_evidence(root_);
}

void Fitter::begin_with(const std::vector<KindPointer>& kinds) {
  std::vector<KindPointer> first;
  for (const std::string& name : first_terms(subject_.changes_volume)) {
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const auto& one) { return one->name == name; });
    if (kind == kinds.end())
      throw InputError(fmt::format(
          "discovery: from nothing, a material that changes its volume begins with the terms {}, and '{}' is not among "
          "the invariants and laws that are asked for, or the data do not show it. Add it to the list",
          fmt::join(first_terms(true), " and "), name));
    first.push_back(*kind);
  }
  auto set = bound(std::move(first));
  std::optional<SetFit> fit;
  if (set) {
    std::vector<double> start = start_of(root_, *set->set);
    const auto& known = evidence_.base->layout().parameters;
    for (std::size_t k = 0; k < known.size(); ++k)
      start[set->set->assembly().layout().index_of(known[k].places.front()).value()] = evidence_.fit.free[k];
    fit = fitted(std::move(*set), start);
  }
  if (!fit)
    throw InputError(
        "discovery: from nothing, the first terms of a material that changes its volume could not be fitted to the "
        "data. Leave \"from_nothing\" out: terms are then looked for beside the model");
  root_ = std::move(*fit);
}

std::optional<SetFit> Fitter::without(const SetFit& from, std::size_t out, double worth) const {
  std::vector<KindPointer> kinds = from.kinds;
  kinds.erase(kinds.begin() + static_cast<std::ptrdiff_t>(out));
  auto found = bound(std::move(kinds));
  if (!found) return std::nullopt;
  const std::vector<double> start = start_of(from, *found->set);
  return fitted(std::move(*found), start, worth);
}

double Fitter::log_evidence(const SetFit& fit) const {
  const double prior = log_prior(fit.kinds, subject_.from_nothing);
  if (!fit.set || fit.fit.jacobian.cols() == 0) return -fit.chi2() / 2 + prior;
  const auto& parameters = fit.set->assembly().layout().parameters;
  Eigen::MatrixXd J = fit.fit.jacobian;
  const double of_box = 1 / std::sqrt(2 * std::numbers::pi), of_amplitude = of_box * std::log(measured_);
  std::vector<bool> amplitude(parameters.size(), false);
  for (const BoundTerm& term : fit.set->terms()) {
    amplitude[term.amplitude] = true;
    for (const std::size_t height : term.heights) amplitude[height] = true;
  }
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    auto column = J.col(static_cast<Eigen::Index>(j));
    if (amplitude[j])
      column *= fit.fit.free[j] * of_amplitude;
    else if (fit.fit.at_bound[j])
      column.setZero();
    else
      column *= slope(parameters[j], fit.fit.free[j]) * of_box;
  }
  // The logarithm of a height that the data hardly hold is no Gaussian: such a height would cost nothing.
  constexpr double of_height = 1;
  double heights = 0;
  for (const BoundTerm& term : fit.set->terms())
    for (const std::size_t height : term.heights) heights += fit.fit.at_bound[height] ? 0 : of_height;
  Eigen::MatrixXd H = J.transpose() * J;
  H.diagonal().array() += 1;
  return -heights - fit.chi2() / 2 - 0.5 * numerics::eigenpairs(H).values.array().max(1.0).log().sum() + prior;
}

double Fitter::largest_amplitude(const Kind& kind) const {
  constexpr double several = 20;
  try {
    // From nothing a term stands beside the neo-Hookean one of the analysis: fibres, and laws without a slope at rest,
    // hold nothing together alone.
    std::vector<KindPointer> kinds{std::make_shared<const Kind>(kind)};
    const bool by_volume = subject_.changes_volume;
    if (subject_.from_nothing)
      kinds.push_back(std::make_shared<const Kind>(Kind{by_volume ? "I1bar" : "I1", {}, "linear", "companion"}));
    if (subject_.from_nothing && by_volume && !kind.of_volume())
      kinds.push_back(std::make_shared<const Kind>(Kind{"J", {}, "quadratic", "volume"}));
    const BoundSet set(subject_, kinds);
    const auto workspace = set.assembly().evaluator().make_workspace();
    std::vector<double> start = start_of(root_, set);
    const auto of_first_term = [&](std::size_t which, const char* amplitude) {
      return evidence_.fit.free[index_of(*evidence_.base, subject_, first_terms(by_volume)[which], amplitude)];
    };
    for (std::size_t k = 1; k < kinds.size(); ++k)
      start[set.terms()[k].amplitude] = of_first_term(k - 1, k == 1 ? "mu" : "K");
    double weakest = INFINITY;
    for (const auto& shapes : combinations(kind)) {
      const BoundTerm& term = set.terms().front();
      const auto& parameter = set.assembly().layout().parameters[term.amplitude];
      start[term.amplitude] = kind.negative ? -1e-4 : std::max(parameter.min, subject_.from_nothing ? 1e-3 : 0.0);
      // Nothing else resists the volume.
      if (by_volume && kind.of_volume()) start[term.amplitude] = of_first_term(1, "K");
      for (std::size_t k = 0; k < shapes.size(); ++k) start[term.shapes[k]] = shapes[k];
      Eigen::VectorXd r;
      Eigen::MatrixXd J;
      if (!diagnosis::whitened(set.assembly(), start, *workspace, r, &J).ok()) continue;
      double effect = J.col(static_cast<Eigen::Index>(term.amplitude)).squaredNorm();
      for (const std::size_t height : term.heights)
        effect = std::max(effect, J.col(static_cast<Eigen::Index>(height)).squaredNorm());
      if (effect > 0) weakest = std::min(weakest, std::sqrt(effect));
    }
    if (!std::isfinite(weakest)) return 0;
    const double most = std::min(several * measured_ / weakest, 1e5);
    return kind.negative ? -std::min(most, 5000.0) : (kind.invariant == "stretches" ? std::min(most, 5000.0) : most);
  } catch (const InputError&) {
    return 0;
  }
}

std::vector<double> Fitter::start_of(const SetFit& from, const BoundSet& set) const {
  const auto& parameters = set.assembly().layout().parameters;
  std::vector<double> start(parameters.size());
  for (std::size_t j = 0; j < parameters.size(); ++j) start[j] = parameters[j].initial;
  if (!from.set) return start;
  const auto& known = from.set->assembly().layout().parameters;
  for (std::size_t j = 0; j < parameters.size(); ++j)
    for (std::size_t k = 0; k < known.size(); ++k)
      if (known[k].name == parameters[j].name)
        start[j] = std::clamp(from.fit.free[k], parameters[j].min, parameters[j].max);
  return start;
}

bool Fitter::has_support(const SetFit& fit) const {
  constexpr double visible = 0.25, of_rows = 0.1;  // σ; of all rows
  const Eigen::MatrixXd& J = fit.fit.jacobian;
  const auto& channels = fit.set->assembly().layout().channels;
  const bool is_whole = subject_.from_nothing && fit.set->terms().size() == 1 &&
                        std::any_of(channels.begin(), channels.end(), [](const auto& one) { return one.is_field(); });
  for (const BoundTerm& term : fit.set->terms()) {
    Eigen::VectorXd effect = J.col(static_cast<Eigen::Index>(term.amplitude)) * fit.fit.free[term.amplitude];
    for (const std::size_t height : term.heights)
      effect += J.col(static_cast<Eigen::Index>(height)) * fit.fit.free[height];
    // The only term scales the forces of a field, and no displacement shows it.
    if (is_whole && effect.norm() > idle) continue;
    const auto rows = (effect.array().abs() > visible).count();
    if (!(effect.norm() > idle) || static_cast<double>(rows) < of_rows * static_cast<double>(effect.size()))
      return false;
  }
  return true;
}

std::optional<SetFit> Fitter::bound(std::vector<KindPointer> kinds) const {
  // Sets are sorted by name, so that one set is one however it came about.
  std::stable_sort(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a->name < b->name; });
  SetFit found;
  found.kinds = std::move(kinds);
  try {
    found.set = std::make_shared<const BoundSet>(subject_, found.kinds);
  } catch (const InputError&) {
    return std::nullopt;
  }
  return found;
}

std::optional<SetFit> Fitter::with_linear(const SetFit& from, std::size_t out, const KindPointer& linear) const {
  const BoundTerm& term = from.set->terms()[out];
  const double modulus = from.fit.free[term.amplitude] * from.fit.free[term.shapes.front()] / 2;
  std::vector<KindPointer> kinds = from.kinds;
  kinds[out] = linear;
  auto found = bound(std::move(kinds));
  if (!found) return std::nullopt;
  const assembly::Assembly& assembly = found->set->assembly();
  std::vector<double> start = start_of(from, *found->set);
  for (std::size_t k = 0; k < found->kinds.size(); ++k)
    if (found->kinds[k] == linear) {
      const std::size_t at = found->set->terms()[k].amplitude;
      const auto& parameter = assembly.layout().parameters[at];
      start[at] = std::clamp(modulus, parameter.min, parameter.max);
    }
  return fitted(std::move(*found), start);
}

std::optional<SetFit> Fitter::fitted(SetFit set, const std::vector<double>& start, double worth) const {
  const assembly::Assembly& assembly = set.set->assembly();
  set.fit = diagnosis::least_squares(assembly, diagnosis::all_variables(assembly), start,
                                     *assembly.evaluator().make_workspace(), effort_.evaluations,
                                     {.wanted = wanted_for(worth), .negligible = diagnosis::says_nothing});
  if (!set.fit.status.ok() || !has_support(set) || has_shape_at_bound(set)) return std::nullopt;
  set.log_evidence = log_evidence(set);
  return set;
}

std::optional<SetFit> Fitter::refitted(const SetFit& before, const std::vector<KindPointer>& kinds,
                                       double worth) const {
  if (kinds.empty()) return root_;
  auto found = bound(kinds);
  if (!found) return std::nullopt;
  const std::vector<double> start = start_of(before, *found->set);
  return fitted(std::move(*found), start, worth);
}

std::optional<Growth> Fitter::growth(const SetFit& from, const KindPointer& more) const {
  const Kind& kind = *more;
  std::vector<KindPointer> kinds = from.kinds;
  kinds.push_back(more);
  auto larger = bound(std::move(kinds));
  if (!larger) return std::nullopt;
  std::size_t own = 0;
  for (std::size_t k = 0; k < larger->kinds.size(); ++k)
    if (larger->kinds[k]->name == kind.name) own = k;
  const assembly::Assembly& assembly = larger->set->assembly();
  const auto& parameters = assembly.layout().parameters;
  const BoundTerm& term = larger->set->terms()[own];
  const auto workspace = assembly.evaluator().make_workspace();
  const std::vector<double> beginning = start_of(from, *larger->set);
  const Projection absorbed(diagnosis::interior(from.fit));
  std::vector<Promise> promises;
  for (const auto& shapes : combinations(kind)) {
    std::vector<double> at = beginning;
    const double nothing = subject_.from_nothing ? 1e-4 * parameters[term.amplitude].max : 0.0;
    at[term.amplitude] = kind.negative ? -1e-4 * std::abs(parameters[term.amplitude].min)
                                       : std::max(parameters[term.amplitude].min, nothing);
    for (const std::size_t height : term.heights) at[height] = parameters[height].min;
    for (std::size_t k = 0; k < shapes.size(); ++k) at[term.shapes[k]] = shapes[k];
    Eigen::VectorXd r;
    Eigen::MatrixXd J;
    if (!diagnosis::whitened(assembly, at, *workspace, r, &J).ok() || !J.allFinite()) continue;
    Eigen::VectorXd signature = J.col(static_cast<Eigen::Index>(term.amplitude));
    for (const std::size_t height : term.heights) signature += J.col(static_cast<Eigen::Index>(height));
    Promise promise = promise_of(kind, absorbed, from.fit.residuals, std::move(signature));
    promise.shapes = shapes;
    if (promise.gain > 0) promises.push_back(std::move(promise));
  }
  std::stable_sort(promises.begin(), promises.end(),
                   [](const Promise& a, const Promise& b) { return a.gain > b.gain; });
  constexpr double worth_trying = 4;
  if (promises.empty() || promises.front().gain < worth_trying) return std::nullopt;
  if (promises.size() > effort_.starts) promises.resize(effort_.starts);
  constexpr double optimism = 3;  // so many times what the linearisation promises a fit may reach
  const double most = from.log_evidence + optimism * promises.front().gain / 2;
  return Growth{std::move(*larger), own, std::move(promises), most};
}

std::optional<SetFit> Fitter::grown(const SetFit& from, const KindPointer& more, double worth) const {
  auto growth = this->growth(from, more);
  return growth ? grown(from, std::move(*growth), worth) : std::nullopt;
}

std::optional<SetFit> Fitter::grown(const SetFit& from, Growth growth, double worth) const {
  if (growth.most < worth) return std::nullopt;
  SetFit& found = growth.larger;
  const assembly::Assembly& assembly = found.set->assembly();
  const auto& parameters = assembly.layout().parameters;
  const BoundTerm& term = found.set->terms()[growth.own];
  const auto workspace = assembly.evaluator().make_workspace();
  const std::vector<double> beginning = start_of(from, *found.set);

  std::vector<std::size_t> amplitudes = term.heights;
  amplitudes.push_back(term.amplitude);
  bool ok = false;
  double share = 1;
  for (const Promise& promise : growth.promises) {
    std::vector<double> at = beginning;
    const double amplitude = share * promise.amplitude;
    for (const std::size_t index : amplitudes)
      at[index] = std::clamp(amplitude, parameters[index].min, parameters[index].max);
    for (std::size_t k = 0; k < promise.shapes.size(); ++k) at[term.shapes[k]] = promise.shapes[k];
    // What the others do when it is added: J Δ = −s a.
    if (from.set && from.fit.jacobian.cols() > 0) {
      Eigen::MatrixXd scaled = from.fit.jacobian;
      const Eigen::VectorXd lengths = scaled.colwise().norm().cwiseMax(1e-300);
      for (Eigen::Index c = 0; c < scaled.cols(); ++c) scaled.col(c) /= lengths[c];
      const Eigen::VectorXd shift =
          numerics::least_squares_solution(scaled, -promise.signature * amplitude, 1e-6).cwiseQuotient(lengths);
      const auto& known = from.set->assembly().layout().parameters;
      for (std::size_t k = 0; k < known.size(); ++k)
        for (std::size_t j = 0; j < parameters.size(); ++j) {
          if (parameters[j].name != known[k].name || j == term.amplitude) continue;
          const double step = shift[static_cast<Eigen::Index>(k)];
          if (parameters[j].scale == Scale::log)
            at[j] *= std::exp(std::clamp(step / at[j], -1.0, 1.0));
          else
            at[j] += std::clamp(step, -0.3 * (parameters[j].max - parameters[j].min),
                                0.3 * (parameters[j].max - parameters[j].min));
          at[j] = std::clamp(at[j], parameters[j].min, parameters[j].max);
        }
    }
    share = 0.3;
    Fit fit =
        diagnosis::least_squares(assembly, diagnosis::all_variables(assembly), at, *workspace, effort_.evaluations,
                                 {.wanted = wanted_for(worth), .negligible = diagnosis::says_nothing});
    if (!fit.status.ok() || (ok && fit.chi2 >= found.fit.chi2)) continue;
    found.fit = std::move(fit);
    ok = true;
    if (found.fit.chi2 < from.fit.chi2 - as_promised * promise.gain) break;
  }
  if (!ok || !has_support(found) || has_shape_at_bound(found)) return std::nullopt;
  found.log_evidence = log_evidence(found);
  return std::move(found);
}

}  // namespace tunica::discovery
