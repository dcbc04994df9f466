// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/base_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "diagnosis/evidence/projection.hpp"
#include "text/lists.hpp"
#include "text/units.hpp"
#include "tunica/random.hpp"
#include "uncertainty/refit.hpp"

namespace tunica::diagnosis {
namespace {

std::vector<std::vector<double>> random_starts(const assembly::Assembly& assembly, std::size_t count,
                                               std::uint64_t seed) {
  boost::random::mt19937_64 generator(derive_seed(seed, "starts of the base fit"));
  boost::random::uniform_real_distribution<double> uniform(0.02, 0.98);
  std::vector<std::vector<double>> starts;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double> unit(assembly.layout().parameters.size()), free(unit.size());
    for (double& x : unit) x = uniform(generator);
    assembly.box().from_unit(unit, free);
    starts.push_back(std::move(free));
  }
  return starts;
}

/// The end point of the requested optimizer, or the reason why there is none.
struct OptimizerStart {
  std::vector<double> free = {};
  std::vector<Warning> warnings = {};
};

OptimizerStart optimizer_start(const Inquiry& inquiry, const Preparation& prepared,
                               const std::vector<double>& initial) {
  const assembly::Assembly& assembly = *prepared.base;
  const std::string& name = inquiry.request.optimizer;
  const auto& entry = prepared.experiment.optimizer(name);
  if (!entry.stages.empty())
    return {{},
            {{WarningKind::optimizer_has_stages,
              fmt::format("diagnosis.optimizer '{}' has stages and is not used here. Name one of its stages", name)}}};
  const uncertainty::LocalOptimizer optimizer{&inquiry.catalogue.optimizers().find(entry.type)->second, entry.options};
  const uncertainty::RefitObjective target{
      assembly.layout().blocks, assembly.layout().residual_count,
      [&assembly](auto free, double& objective, auto residuals, auto jacobian, auto& workspace) {
        return assembly.evaluator().evaluate(free, objective, {}, residuals, jacobian, workspace);
      }};
  const auto workspace = assembly.evaluator().make_workspace();
  const auto found =
      uncertainty::refit(assembly, target, optimizer, initial, std::nullopt, inquiry.request.seed, *workspace);
  if (found.status.ok()) return {found.free};
  return {
      {},
      {{WarningKind::optimizer_failed,
        fmt::format("the optimizer '{}' found no start for the base fit: {}. The base fit used its own starts only. "
                    "Look at what `tunica run` reports for it",
                    name, found.status.reason())}}};
}

/// The predictions plus the mean residual of the seven rows around each: the measured curve with little noise.
std::vector<double> smoothed_level(const assembly::MeasuredChannel& view, std::span<const double> predicted) {
  constexpr std::size_t half = 3;
  std::vector<double> level(predicted.begin(), predicted.end());
  for (std::size_t i = 0; i < view.count; ++i) {
    const std::size_t from = i < half ? 0 : i - half, to = std::min(view.count, i + half + 1);
    double sum = 0;
    std::size_t measured = 0;
    for (std::size_t k = from; k < to; ++k) {
      if (std::isnan(view.measured[k])) continue;
      sum += view.measured[k] - predicted[k];
      ++measured;
    }
    if (measured > 0) level[i] += sum / static_cast<double>(measured);
  }
  return level;
}

/// Relative noise taken of these predictions.
experiment::Experiment with_noise_levels(experiment::Experiment experiment, const assembly::Assembly& base,
                                         std::span<const double> predicted) {
  for (const assembly::MeasuredChannel& view : base.layout().channels)
    for (auto& test : experiment.tests) {
      if (test.name != view.test) continue;
      for (auto& [channel, noise] : test.data.noise)
        if (channel == view.observable && noise.relative > 0)
          noise.level = smoothed_level(view, predicted.subspan(view.offset, view.count));
    }
  return experiment;
}

/// A bound that keeps the model away from the data looks like a cause. The model's declared range does not count as
/// such a bound.
std::optional<Warning> bound_warning(const assembly::Assembly& assembly, const Fit& fit) {
  std::vector<std::string> bounds;
  const auto& parameters = assembly.layout().parameters;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const assembly::FreeParameter& p = parameters[j];
    const double near = 1e-6 * (p.max - p.min);
    const bool lower = fit.free[j] - p.min <= near && p.min > p.declared.min,
               upper = p.max - fit.free[j] <= near && p.max < p.declared.max;
    if (lower || upper)
      bounds.push_back(fmt::format("{} = {:.4g}{} ({} bound)", p.name, lower ? p.min : p.max, text::unit_suffix(p.unit),
                                   lower ? "lower" : "upper"));
  }
  if (bounds.empty()) return std::nullopt;
  return Warning{WarningKind::base_fit_at_bound,
                 fmt::format("the base model is held back by its bounds: {}. What is named below may only make up for "
                             "that. Widen them and diagnose again, before anything else is believed",
                             text::joined(bounds))};
}

/// The predicted decrease of |r|² by one more step of the parameters.
double step_promises(const Fit& fit) { return fit.chi2 - Projection(interior(fit)).off(fit.residuals).squaredNorm(); }

}  // namespace

BaseFit fit_base(const Inquiry& inquiry, const Preparation& prepared) {
  constexpr std::size_t batches = 4;
  constexpr double far = 0.01, no_fit = 0.5, matters = 10;  // of |r|², and more than noise in so many rows
  constexpr double same = 1;                                // of |r|²: minima that lie closer are one
  const assembly::Assembly& assembly = *prepared.base;
  const bool quick = inquiry.request.quick;
  const std::vector<Variable> variables = all_variables(assembly);
  std::vector<double> initial(assembly.layout().parameters.size());
  assembly.box().from_unit(assembly.box().initial(), initial);
  std::vector<std::vector<double>> starts = random_starts(assembly, quick ? 3 : 8, inquiry.request.seed);
  starts.insert(starts.begin(), initial);
  BaseFit base;
  if (!quick && !inquiry.request.optimizer.empty()) {
    OptimizerStart start = optimizer_start(inquiry, prepared, initial);
    if (start.warnings.empty()) starts.push_back(std::move(start.free));
    base.warnings = std::move(start.warnings);
  }
  std::vector<Fit> fits(starts.size());
  const auto done = inquiry.steps("fitting the base model", 0.05, 0.1, starts.size());
  tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t k) {
    const auto workspace = assembly.evaluator().make_workspace();
    fits[k] = least_squares(assembly, variables, starts[k], *workspace, k == 0 || !quick ? 200 : 60);
    done();
  });
  const Fit* best = nullptr;
  for (const Fit& fit : fits)
    if (fit.status.ok() && (!best || fit.chi2 < best->chi2)) best = &fit;
  if (!best)
    throw BaseFitFailure(fmt::format("diagnosis: the base model cannot be evaluated from any of {} starts: {}",
                                     fits.size(), fits.front().status.reason()));
  base.fit = *best;
  // A search that ended early gets more starts and more steps.
  const auto promises = [](const Fit& fit, double share) {
    return step_promises(fit) > std::max({share * fit.chi2, matters, static_cast<double>(fit.residuals.size())});
  };
  // The lowest minimum counts as found if two starts have reached it. The misfit of a poorer one would look like a
  // cause, and hides among noise where it is as small.
  // Of many starts a third has to end there, since two may have reached a poorer minimum. A misfit that is no noise is
  // believed after a batch more.
  const double rows = static_cast<double>(base.fit.residuals.size()), noise_alone = rows + 2 * std::sqrt(2 * rows);
  const auto is_open = [&](const std::vector<Fit>& ended) {
    const auto there = std::ranges::count_if(
        ended, [&](const Fit& fit) { return fit.status.ok() && fit.chi2 <= (1 + far) * base.fit.chi2 + same; });
    const auto fitted = std::ranges::count_if(ended, [](const Fit& fit) { return fit.status.ok(); });
    const bool few = there < 2 || 3 * there < fitted;
    const bool doubtful = ended.size() == starts.size() && base.fit.chi2 > noise_alone;
    return !assembly.layout().has_costly_tests && (few || doubtful);
  };
  std::vector<Fit> ended = fits;
  for (std::size_t batch = 0;
       batch < batches && (batch == 0 ? promises(base.fit, far) || is_open(ended) : is_open(ended)); ++batch) {
    std::vector<std::vector<double>> more = random_starts(assembly, 12, inquiry.request.seed + 1 + batch);
    if (batch == 0) more.push_back(base.fit.free);
    fits.assign(more.size(), {});
    tbb::parallel_for(std::size_t{0}, more.size(), [&](std::size_t k) {
      fits[k] = least_squares(assembly, variables, more[k], *assembly.evaluator().make_workspace(), 400);
    });
    for (const Fit& fit : fits)
      if (fit.status.ok() && fit.chi2 < base.fit.chi2) base.fit = fit;
    ended.insert(ended.end(), fits.begin(), fits.begin() + 12);  // the best one again is no second start
  }
  if (!inquiry.request.from_scaffold && promises(base.fit, no_fit))
    throw BaseFitFailure(fmt::format(
        "diagnosis: the base model comes to no optimum: one more step promises to take {:.0f} % of |r|² = {:.4g}. Give "
        "its parameters initial values and bounds, and look at what `tunica run` finds",
        100 * step_promises(base.fit) / base.fit.chi2, base.fit.chi2));
  if (auto warning = bound_warning(assembly, base.fit))
    base.warnings.insert(base.warnings.begin(), std::move(*warning));
  // Scores presuppose an optimum: a step of the parameters must not reduce the residuals any further.
  if (const double left = step_promises(base.fit); left > 0.1)
    base.warnings.push_back(
        {WarningKind::base_fit_not_optimal,
         fmt::format("the base fit is not a clear optimum: one more step could lower |r|² by {:.2g}. Take the scores "
                     "for less certain than they look",
                     left)});
  return base;
}

SettledFit settle_noise(const Inquiry& inquiry, const Preparation& prepared, const Fit& fit) {
  const auto relative = [](const NoiseSource& source) { return source.noise.relative > 0; };
  if (std::none_of(prepared.noise.begin(), prepared.noise.end(), relative))
    return {prepared.experiment, prepared.base, fit};
  std::vector<double> predicted(prepared.base->layout().prediction_count);
  if (!prepared.base->evaluator().predict(fit.free, predicted, {}, *prepared.base->evaluator().make_workspace()).ok())
    return {prepared.experiment, prepared.base, fit};
  SettledFit settled{with_noise_levels(prepared.experiment, *prepared.base, predicted), nullptr, fit};
  settled.base = std::make_shared<const assembly::Assembly>(settled.experiment, prepared.run, inquiry.catalogue);
  Fit again =
      least_squares(*settled.base, all_variables(*settled.base), fit.free, *settled.base->evaluator().make_workspace());
  if (again.status.ok()) settled.fit = std::move(again);
  return settled;
}

}  // namespace tunica::diagnosis
