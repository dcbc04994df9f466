// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/refits.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include "numerics/orthogonal.hpp"
#include "tunica/error.hpp"
#include "tunica/random.hpp"

namespace tunica::diagnosis {
namespace {

constexpr std::size_t quick_tries = 12, full_tries = 64;
constexpr std::size_t quick_starts = 3, full_starts = 16;   ///< the best of the draws
constexpr std::size_t quick_returns = 1, full_returns = 4;  ///< to the best minimum, after which no other is expected
constexpr double same_minimum = 0.05;                       ///< of |r|²
constexpr double next_to_nothing = 0.01;                    ///< of the amplitude that the scores promise

/// The signature of an addition at the base fit, on the side of the amplitude; or null.
const Hypothesis* hypothesis_of(const Hypotheses& hypotheses, const Addition& addition, double amplitude) {
  for (const Candidate& candidate : hypotheses.candidates)
    for (const Hypothesis& hypothesis : candidate.hypotheses)
      if (candidate.id == addition.id && hypothesis.addition.place == addition.place &&
          hypothesis.addition.setting == addition.setting && hypothesis.addition.pace == addition.pace &&
          (hypothesis.side == MechanismFactory::Side::both || hypothesis.sign * amplitude >= 0))
        return &hypothesis;
  return nullptr;
}

/// The values of a smaller refit in the place of parameters of the same name.
void take_over(const Refit& from, const assembly::Assembly& onto, std::vector<double>& start) {
  const auto& names = from.extension->assembly().layout().parameters;
  const auto& parameters = onto.layout().parameters;
  for (std::size_t j = 0; j < parameters.size(); ++j)
    for (std::size_t k = 0; k < names.size(); ++k)
      if (names[k].name == parameters[j].name)
        start[j] = std::clamp(from.fit.free[k], parameters[j].min, parameters[j].max);
}

}  // namespace

std::optional<Refit> fit_with(const Inquiry& inquiry, const Analysis& analysis, std::vector<Addition> additions,
                              std::span<const double> amplitudes, const Refit* from, Nuisance nuisance) {
  const Evidence& evidence = analysis.evidence;
  const bool quick = inquiry.request.quick;
  Refit refit;
  refit.additions = std::move(additions);
  try {
    refit.extension =
        std::make_shared<const Extension>(evidence.experiment, evidence.run, refit.additions, inquiry.catalogue);
  } catch (const InputError&) {
    return std::nullopt;
  }
  const Extension& extended = *refit.extension;
  refit.additions = extended.additions();
  const auto& parameters = extended.assembly().layout().parameters;
  const auto workspace = extended.assembly().evaluator().make_workspace();
  const std::vector<Variable> variables = extended.variables(nuisance == Nuisance::fitted);

  // What the parameters of the base do when the effect is added: J Δ = −Σ s δ.
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(evidence.fit.residuals.size());
  for (std::size_t a = 0; a < refit.additions.size(); ++a)
    if (const Hypothesis* hypothesis = hypothesis_of(analysis.hypotheses, refit.additions[a], amplitudes[a]))
      moved += hypothesis->signature * (hypothesis->sign * amplitudes[a]);
  Eigen::MatrixXd scaled = evidence.fit.jacobian;
  std::vector<double> lengths;
  for (Eigen::Index k = 0; k < scaled.cols(); ++k) {
    lengths.push_back(std::max(scaled.col(k).norm(), 1e-300));
    scaled.col(k) /= lengths.back();
  }
  Eigen::VectorXd shift;
  if (scaled.cols() > 0)  // a model without free parameters leaves nothing to factorise
    shift = numerics::least_squares_solution(scaled, -moved, 1e-6);

  bool found = false;
  const auto set_amplitude = [&](std::vector<double>& start, std::size_t a, double share) {
    const Extension::Part& part = extended.parts()[a];
    const bool even = inquiry.mechanism(refit.additions[a].id).side == MechanismFactory::Side::even;
    const double amplitude = share * (even ? std::sqrt(std::max(amplitudes[a], 0.0)) : amplitudes[a]);
    for (const std::size_t member : part.amplitude)
      start[member] = std::clamp(part.null + amplitude, parameters[member].min, parameters[member].max);
  };
  if (from != nullptr) {
    std::vector<double> start = extended.at_null(evidence.fit.free);
    take_over(*from, extended.assembly(), start);
    set_amplitude(start, extended.parts().size() - 1, 1);
    Fit fit = least_squares(extended.assembly(), variables, start, *workspace, 60,
                            {.wanted = evidence.fit.chi2, .negligible = says_nothing});
    if (fit.status.ok()) {
      refit.fit = std::move(fit);
      found = true;
    }
  }
  for (const double share : {1.0, 0.3}) {
    if (found && quick && refit.fit.chi2 < evidence.fit.chi2) break;
    std::vector<double> base = evidence.fit.free;
    for (std::size_t j = 0; j < base.size(); ++j) {
      const auto& parameter = evidence.base->layout().parameters[j];
      double step = share * shift[static_cast<Eigen::Index>(j)] / lengths[j];
      if (parameter.scale == Scale::log)  // as far as the straight line can be believed
        base[j] *= std::exp(std::clamp(step / base[j], -1.0, 1.0));
      else
        base[j] += std::clamp(step, -0.3 * (parameter.max - parameter.min), 0.3 * (parameter.max - parameter.min));
      base[j] = std::clamp(base[j], parameter.min, parameter.max);
    }
    std::vector<double> start = extended.at_null(base);
    for (std::size_t a = 0; a < extended.parts().size(); ++a) set_amplitude(start, a, share);
    Fit fit = least_squares(extended.assembly(), variables, start, *workspace, 60,
                            {.wanted = evidence.fit.chi2, .negligible = says_nothing});
    if (!fit.status.ok()) continue;
    if (!found || fit.chi2 < refit.fit.chi2) {
      refit.fit = std::move(fit);
      found = true;
    }
    if (quick && refit.fit.chi2 < evidence.fit.chi2) break;
  }
  // The base is among the extensions: from next to it a search cannot end above it.
  if (found && refit.fit.chi2 > evidence.fit.chi2) {
    std::vector<double> start = extended.at_null(evidence.fit.free);
    for (std::size_t a = 0; a < extended.parts().size(); ++a) set_amplitude(start, a, next_to_nothing);
    if (Fit fit = least_squares(extended.assembly(), variables, start, *workspace, 60,
                                {.wanted = evidence.fit.chi2, .negligible = says_nothing});
        fit.status.ok() && fit.chi2 < refit.fit.chi2)
      refit.fit = std::move(fit);
  }
  if (!found) return std::nullopt;
  return refit;
}

namespace {

/// Random places for what lies at a bound of the base, in every second also for the rest of the base, and amplitudes up
/// to those of a refit; the best first.
std::vector<std::vector<double>> random_starts(const Inquiry& inquiry, const Evidence& evidence, const Refit& refit,
                                               assembly::Workspace& workspace) {
  const Extension& extended = *refit.extension;
  const auto& parameters = extended.assembly().layout().parameters;
  boost::random::mt19937_64 generator(derive_seed(inquiry.request.seed, "starts off the bounds"));
  boost::random::uniform_real_distribution<double> uniform(0.02, 0.98);
  std::vector<std::pair<double, std::vector<double>>> drawn;
  for (std::size_t k = 0; k < (inquiry.request.quick ? quick_tries : full_tries); ++k) {
    std::vector<double> unit(evidence.base->layout().parameters.size()), base(unit.size());
    for (std::size_t j = 0; j < base.size(); ++j) base[j] = refit.fit.free[extended.base()[j]];
    evidence.base->box().to_unit(base, unit);
    for (std::size_t j = 0; j < unit.size(); ++j)
      if (k % 2 == 1 || evidence.fit.at_bound[j]) unit[j] = uniform(generator);
    evidence.base->box().from_unit(unit, base);
    std::vector<double> start = extended.at_null(base);
    for (const Extension::Part& part : extended.parts()) {
      const double share = uniform(generator);
      for (const std::size_t member : part.amplitude)
        start[member] = std::clamp(part.null + share * (refit.fit.free[member] - part.null), parameters[member].min,
                                   parameters[member].max);
    }
    Eigen::VectorXd residuals;
    if (whitened(extended.assembly(), start, workspace, residuals, nullptr).ok())
      drawn.emplace_back(residuals.squaredNorm(), std::move(start));
  }
  std::stable_sort(drawn.begin(), drawn.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  drawn.resize(std::min(drawn.size(), inquiry.request.quick ? quick_starts : full_starts));
  std::vector<std::vector<double>> starts;
  for (auto& [squares, start] : drawn) starts.push_back(std::move(start));
  return starts;
}

}  // namespace

Refit searched_again(const Inquiry& inquiry, const Analysis& analysis, Refit refit, double enough) {
  const Evidence& evidence = analysis.evidence;
  if (!at_a_bound(evidence.fit) || refit.fit.chi2 < enough) return refit;
  const Extension& extended = *refit.extension;
  const auto workspace = extended.assembly().evaluator().make_workspace();
  std::size_t returns = 0;
  for (const std::vector<double>& start : random_starts(inquiry, evidence, refit, *workspace)) {
    Fit fit = least_squares(extended.assembly(), extended.variables(), start, *workspace, 60,
                            {.wanted = refit.fit.chi2, .negligible = says_nothing});
    if (!fit.status.ok()) continue;
    if (fit.chi2 < refit.fit.chi2 - same_minimum)
      returns = 0;
    else if (fit.chi2 < refit.fit.chi2 + same_minimum)
      ++returns;
    if (fit.chi2 < refit.fit.chi2) refit.fit = std::move(fit);
    if (refit.fit.chi2 < enough || returns >= (inquiry.request.quick ? quick_returns : full_returns)) break;
  }
  return refit;
}

}  // namespace tunica::diagnosis
