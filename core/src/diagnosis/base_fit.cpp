// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/base_fit.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include "diagnosis/causes.hpp"
#include "tunica/error.hpp"
#include "tunica/random.hpp"
#include "uncertainty/refit.hpp"

namespace tunica::diagnosis {
namespace {

/// The run that fits this model; null where none does.
const experiment::RunEntry* run_of(const experiment::Experiment& experiment, const std::string& model) {
  for (const experiment::RunEntry& run : experiment.runs)
    if (run.model == model) return &run;
  return nullptr;
}

/// The tests of that run, or all.
std::vector<std::string> tests_of(const experiment::Experiment& experiment, const experiment::RunEntry* run) {
  if (run != nullptr) return run->tests;
  std::vector<std::string> names;
  for (const auto& test : experiment.tests) names.push_back(test.name);
  return names;
}

/// What the file asks of the run and a diagnosis does not keep to.
void tell_of_constraints(Diagnosis& d, const experiment::RunEntry* run) {
  if (run == nullptr || run->constraints.empty()) return;
  std::vector<std::string> types;
  for (const experiment::ConstraintEntry& constraint : run->constraints) types.push_back(constraint.type);
  d.warnings.push_back(fmt::format(
      "the constraints of the run ({}) do not bind the fits of a diagnosis: a bound that holds a fit back would pass "
      "for a misfit of the model; lost stability is reported, and is a misfit with \"admissibility\": true",
      fmt::join(types, ", ")));
}

/// Weights say what a channel is worth to a run; here its noise does. But one of weight 0 takes no part.
void take_out_unweighted(Diagnosis& d, const plugins::Catalogue& catalogue) {
  for (auto& test : d.experiment.tests) {
    std::vector<double> weights;
    std::swap(weights, test.weights);
    const bool here = std::find(d.run.tests.begin(), d.run.tests.end(), test.name) != d.run.tests.end();
    if (!here || std::find(weights.begin(), weights.end(), 0.0) == weights.end()) continue;
    const auto channels =
        data::read_dataset(test.data, catalogue.tests().find(test.type)->second.factory.observables).channels;
    std::vector<std::string> silent;
    for (std::size_t k = 0; k < weights.size(); ++k)
      if (weights[k] == 0) silent.push_back(channels[k].observable);
    d.warnings.push_back(fmt::format("test '{}': {} of weight 0 takes no part; give it a weight to have it judged too",
                                     test.name, fmt::join(silent, " and ")));
    if (silent.size() == channels.size()) {
      test.hold_out.all = true;
      continue;
    }
    const auto is_silent = [&](const auto& entry) {
      return std::find(silent.begin(), silent.end(), entry.first) != silent.end();
    };
    std::erase_if(test.data.columns, is_silent);
    std::erase_if(test.data.noise, is_silent);
  }
}

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

/// The predictions, moved by the mean residual of the seven rows around each: what is measured, with little of its
/// noise.
std::vector<double> smoothed(const assembly::MeasuredChannel& view, std::span<const double> predicted) {
  constexpr std::size_t half = 3;
  std::vector<double> level(predicted.begin(), predicted.end());
  for (std::size_t i = 0; i < view.count; ++i) {
    const std::size_t from = i < half ? 0 : i - half, to = std::min(view.count, i + half + 1);
    double sum = 0;
    for (std::size_t k = from; k < to; ++k) sum += view.measured[k] - predicted[k];
    level[i] += sum / static_cast<double>(to - from);
  }
  return level;
}

}  // namespace

std::vector<Curve> curves_of(const assembly::Assembly& assembly, const std::vector<NoiseSource>& noise) {
  std::vector<Curve> curves;
  Eigen::Index at = 0;
  for (const assembly::MeasuredChannel& view : assembly.layout().channels) {
    Curve curve{view.test, view.observable, at, 0, {}, {}, {}};
    for (std::size_t i = 0; i < view.count; ++i)
      if (view.fitted[i]) curve.abscissa.push_back(view.abscissa[i]), curve.rows.push_back(i);
    curve.count = static_cast<Eigen::Index>(curve.rows.size());
    if (curve.count == 0) continue;
    for (const NoiseSource& source : noise)
      if (source.test == view.test && source.channel == view.observable) curve.noise = source;
    at += curve.count;
    curves.push_back(std::move(curve));
  }
  return curves;
}

void prepare(Diagnosis& d, const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
             const std::vector<GrossRow>& gross) {
  d.experiment = experiment;
  d.run.model = d.settings.model;
  const experiment::RunEntry* const run = run_of(experiment, d.settings.model);
  d.run.tests = tests_of(experiment, run);
  d.run.optimizer = d.settings.optimizer;
  d.run.objective = experiment::ObjectiveType::least_squares;
  take_out_unweighted(d, catalogue);
  d.noise = state_noise(d.experiment, d.run.tests, catalogue, gross);
  d.base = std::make_unique<assembly::Assembly>(d.experiment, d.run, catalogue);
  d.curves = curves_of(*d.base, d.noise);
  if (d.curves.empty())
    throw InputError(
        "diagnosis: every test is held out, so that there is nothing to diagnose; set hold_out to false in one");
  if (d.base->layout().parameters.size() >= d.base->layout().residual_count)
    throw InputError(
        fmt::format("diagnosis: {} parameters are fitted to {} rows, which leaves nothing to judge by; fix "
                    "parameters or give more rows",
                    d.base->layout().parameters.size(), d.base->layout().residual_count));
  tell_of_constraints(d, run);
  for (const auto& test : d.experiment.tests)
    if (test.hold_out.all && std::find(d.run.tests.begin(), d.run.tests.end(), test.name) != d.run.tests.end())
      d.warnings.push_back(fmt::format(
          "test '{}' is held out and takes no part; set hold_out to false to have it judged too", test.name));
  for (const NoiseSource& source : d.noise)
    if (source.kind == NoiseSource::Kind::differences)
      d.warnings.push_back(fmt::format(
          "test '{}', channel '{}': no noise is stated; σ = {:.3g}{} from differences of neighbouring rows. Where rows "
          "err alike it is too small, and the alarm comes too easily; where few rows bend it is too large, and what is "
          "wrong can hide; state noise.absolute, noise.relative and noise.correlation, or give replicates",
          source.test, source.channel, source.noise.absolute, source.unit == "1" ? "" : " " + source.unit));
}

void fit_base(Diagnosis& d, const plugins::Catalogue& catalogue) {
  const assembly::Assembly& assembly = *d.base;
  std::vector<Variable> variables;
  for (std::size_t j = 0; j < assembly.layout().parameters.size(); ++j) variables.push_back({j});
  std::vector<double> initial(assembly.layout().parameters.size());
  assembly.box().from_unit(assembly.box().initial(), initial);
  std::vector<std::vector<double>> starts = random_starts(assembly, d.settings.quick ? 3 : 8, d.settings.seed);
  starts.insert(starts.begin(), initial);
  if (!d.settings.quick && !d.settings.optimizer.empty()) {
    const auto& entry = d.experiment.optimizer(d.settings.optimizer);
    if (!entry.stages.empty()) {
      d.warnings.push_back(fmt::format(
          "diagnosis.optimizer '{}' has stages and is not used here; name one of its stages", d.settings.optimizer));
    } else {
      const uncertainty::LocalOptimizer optimizer{&catalogue.optimizers().find(entry.type)->second, entry.options};
      const uncertainty::RefitObjective target{
          assembly.layout().blocks, assembly.layout().residual_count,
          [&assembly](auto free, double& objective, auto residuals, auto jacobian, auto& workspace) {
            return assembly.evaluator().evaluate(free, objective, {}, residuals, jacobian, workspace);
          }};
      const auto workspace = assembly.evaluator().make_workspace();
      const auto found =
          uncertainty::refit(assembly, target, optimizer, initial, std::nullopt, d.settings.seed, *workspace);
      if (found.status.ok())
        starts.push_back(found.free);
      else
        d.warnings.push_back(
            fmt::format("the optimizer '{}' found no start for the base fit, which began from its own ones only: {}; "
                        "look at what `tunica run` says of it",
                        d.settings.optimizer, found.status.reason()));
    }
  }
  std::vector<Fit> fits(starts.size());
  tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t k) {
    const auto workspace = assembly.evaluator().make_workspace();
    fits[k] = least_squares(assembly, variables, starts[k], *workspace, k == 0 || !d.settings.quick ? 200 : 60);
  });
  const Fit* best = nullptr;
  for (const Fit& fit : fits)
    if (fit.status.ok() && (!best || fit.chi2 < best->chi2)) best = &fit;
  if (!best)
    throw std::runtime_error(fmt::format("diagnosis: the base model cannot be evaluated from any of {} starts: {}",
                                         fits.size(), fits.front().status.reason()));
  d.fit = *best;
  // Scores presuppose an optimum: what of the residuals a step of the parameters could still take away must be nothing.
  const Projection projection(interior(d.fit));
  const double left = d.fit.chi2 - projection.off(d.fit.residuals).squaredNorm();
  if (left > 0.1)
    d.warnings.push_back(
        fmt::format("the base fit is no clear optimum: a further step promises to lower |r|² by {:.2g}; "
                    "scores are less sharp than they look",
                    left));
}

void settle_noise(Diagnosis& d, const plugins::Catalogue& catalogue) {
  const auto relative = [](const NoiseSource& source) { return source.noise.relative > 0; };
  if (std::none_of(d.noise.begin(), d.noise.end(), relative)) return;
  std::vector<double> predicted(d.base->layout().prediction_count);
  if (!d.base->evaluator().predict(d.fit.free, predicted, {}, *d.base->evaluator().make_workspace()).ok()) return;
  for (const assembly::MeasuredChannel& view : d.base->layout().channels)
    for (auto& test : d.experiment.tests) {
      if (test.name != view.test) continue;
      for (auto& [channel, noise] : test.data.noise)
        if (channel == view.observable && noise.relative > 0) {
          noise.level = smoothed(view, {predicted.data() + view.offset, view.count});
        }
    }
  d.base = std::make_unique<assembly::Assembly>(d.experiment, d.run, catalogue);
  std::vector<Variable> variables;
  for (std::size_t j = 0; j < d.base->layout().parameters.size(); ++j) variables.push_back({j});
  if (Fit fit = least_squares(*d.base, variables, d.fit.free, *d.base->evaluator().make_workspace()); fit.status.ok())
    d.fit = std::move(fit);
}

}  // namespace tunica::diagnosis
