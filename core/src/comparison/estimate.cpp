// SPDX-License-Identifier: Apache-2.0
#include "comparison/estimate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/quality.hpp"
#include "comparison/hold_out.hpp"
#include "comparison/neighbours.hpp"
#include "plugins/limited_work.hpp"
#include "text/lists.hpp"
#include "uncertainty/identifiability.hpp"
#include "uncertainty/mesh_bias.hpp"

namespace tunica::comparison {

namespace {

using execution::WarningKind;

/// Share of the search range, in the coordinate the optimiser sees, within which a value counts as being on a bound.
constexpr double on_bound = 1e-6;

/// The best point once more, with a workspace that has seen nothing else. A search that starts from the solution
/// before may end a solver a few roundings elsewhere, no further.
void evaluate_again(const assembly::Assembly& assembly, const execution::RealisationResult& best, RunSummary& summary,
                    std::vector<execution::Warning>& warnings) {
  auto workspace = assembly.evaluator().make_workspace();
  summary.per_test.resize(summary.tests.size());
  double objective = 0;
  summary.status = assembly.evaluator().evaluate(best.best.parameters, objective, summary.per_test, {}, {}, *workspace);
  if (summary.status.kind() == Status::Kind::failed) {
    warnings.push_back({WarningKind::not_evaluated_again,
                        "the best point could not be evaluated again: " + summary.status.reason(), summary.label});
    return;
  }
  if (summary.status.kind() == Status::Kind::infeasible && assembly.layout().has_costly_tests) {
    summary.objective = objective;  // the search may have left them out
    return;
  }
  if (std::abs(objective - best.best.objective) > 1e-9 * std::abs(best.best.objective) + 1e-12)
    warnings.push_back({WarningKind::not_repeatable,
                        fmt::format("the best point gives the objective {}, but the search recorded {}; the model or "
                                    "the test does not give the same answer twice",
                                    objective, best.best.objective),
                        summary.label});
}

void add_parameters(const assembly::Assembly& assembly, const execution::RealisationResult& best,
                    const execution::RunResult& all, RunSummary& summary) {
  const auto& declared = assembly.layout().parameters;
  const auto& values = best.best.parameters;
  std::vector<double> unit(values.size());
  assembly.box().to_unit(values, unit);
  for (std::size_t j = 0; j < declared.size(); ++j) {
    Estimate estimate;
    estimate.name = declared[j].name;
    estimate.unit = declared[j].unit;
    estimate.value = values[j];
    estimate.min = declared[j].min;
    estimate.max = declared[j].max;
    if (unit[j] <= on_bound) estimate.at_bound = Estimate::Bound::lower;
    if (unit[j] >= 1 - on_bound) estimate.at_bound = Estimate::Bound::upper;
    estimate.lower_kind = declared[j].kind_of(false);
    estimate.upper_kind = declared[j].kind_of(true);
    std::vector<double> sample;
    for (const auto& realisation : all.realisations)
      if (realisation.best.feasible()) sample.push_back(realisation.best.parameters[j]);
    estimate.over_realisations = sample_statistics(sample);
    summary.parameters.push_back(std::move(estimate));
  }
}

/// p = p(x) in the unit box: to first order cov p = diag(dp/dx) cov x diag(dp/dx).
void add_covariance(const assembly::Assembly& assembly, const std::vector<double>& best,
                    const uncertainty::Identifiability& found, ParameterCovariance& covariance) {
  const auto& parameters = assembly.layout().parameters;
  covariance.search = found.covariance;
  std::size_t at = 0;
  for (const std::size_t i : found.fixed_by_data) {
    covariance.parameters.push_back({parameters[i].name, parameters[i].unit, parameters[i].scale});
    for (const std::size_t j : found.fixed_by_data)
      covariance.values.push_back(found.covariance[at++] * assembly.box().slope(i, best[i]) *
                                  assembly.box().slope(j, best[j]));
  }
}

/// In a state: var(p' − p) = var p' + var p − 2 cov(p', p), with the quantile of the interval of p'.
void add_state_differences(const assembly::Assembly& assembly, const std::vector<double>& best,
                           const uncertainty::Identifiability* found, RunSummary& summary) {
  const auto& layout = assembly.layout();
  const auto place_of = [](const auto& all, const std::string& name) {
    return static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == name; }) - all.begin());
  };
  const auto& fixed = summary.covariance.parameters;
  for (const assembly::Differing& one : layout.differing) {
    const std::size_t own = place_of(layout.parameters, one.own), from = place_of(layout.parameters, one.name),
                      held = place_of(layout.fixed_parameters, one.name);
    if (own == layout.parameters.size()) continue;  // fixed in the state
    const bool is_free = from < layout.parameters.size();
    if (!is_free && held == layout.fixed_parameters.size()) continue;  // shared under another name
    Estimate::StateDifference difference{one.state, one.name, 0, {}};
    difference.value = best[own] - (is_free ? best[from] : layout.fixed_parameters[held].value);
    const std::size_t i = place_of(fixed, one.own), j = place_of(fixed, one.name), n = fixed.size();
    if (found != nullptr && i < n && (j < n || !is_free) && std::isfinite(found->parameters[own].ci95)) {
      const auto& cov = summary.covariance.values;
      const double variance = cov[i * n + i] + (is_free ? cov[j * n + j] - 2 * cov[i * n + j] : 0);
      const double half = found->parameters[own].ci95 * std::sqrt(std::max(variance, 0.0) / cov[i * n + i]);
      difference.ci95 = {difference.value - half, difference.value + half};
    }
    summary.parameters[own].difference = std::move(difference);
  }
}

void warn_of_coarse_mesh(const RunSummary& summary, std::vector<execution::Warning>& warnings) {
  std::vector<std::string> names;
  double worst = 0;
  for (const Estimate& one : summary.parameters) {
    if (!one.mesh_bias_matters()) continue;
    names.push_back(one.name);
    worst = std::max(worst, 2 * std::abs(*one.mesh_bias) / (one.ci95->second - one.ci95->first));
  }
  if (names.empty()) return;
  warnings.push_back({WarningKind::mesh_biases_parameters,
                      fmt::format("a finer mesh would move {} by up to {:.2g} half widths of {} 95 % {}, which say "
                                  "nothing of the mesh. Take smaller elements",
                                  text::joined(names), worst, text::agreeing(names.size(), "its", "their"),
                                  text::agreeing(names.size(), "interval", "intervals")),
                      summary.label});
}

/// What finite elements on a finer mesh would make of the parameters.
void add_mesh_bias(const assembly::Assembly& assembly, const std::vector<double>& best,
                   const uncertainty::Identifiability& found, const plugins::LimitedWork& work, RunSummary& summary,
                   std::vector<execution::Warning>& warnings) {
  uncertainty::MeshBias bias;
  const Status status = uncertainty::mesh_bias(assembly, summary.tests, best, found, bias);
  if (work.is_over()) {
    summary.notes.emplace_back("what a finer mesh would change is left out: max_time was over");
    return;
  }
  if (!status.ok()) {
    summary.notes.push_back("the simulation could not be compared with a finer one: " + status.reason());
    return;
  }
  for (std::size_t j = 0; j < bias.of_parameter.size(); ++j)
    if (std::isfinite(bias.of_parameter[j])) summary.parameters[j].mesh_bias = bias.of_parameter[j];
  warn_of_coarse_mesh(summary, warnings);
}

/// Intervals from the noise of the data where they fix a parameter, and in words what they do not.
void add_identifiability(const assembly::Assembly& assembly, const execution::RealisationResult& best,
                         const plugins::LimitedWork& work, RunSummary& summary,
                         std::vector<execution::Warning>& warnings) {
  add_state_differences(assembly, best.best.parameters, nullptr, summary);
  if (summary.status.kind() == Status::Kind::infeasible) return;  // not needed at an infeasible point
  uncertainty::Identifiability found;
  const Status status = work.is_over() ? Status::failed("max_time was over")
                                       : uncertainty::identify(assembly, best.best.parameters, found);
  if (!status.ok() && work.is_over()) {
    warnings.push_back({WarningKind::not_linearised,
                        "there are no confidence intervals: max_time was over, which the work on the best point may "
                        "take once more. Raise \"max_time\" in \"stop\"",
                        summary.label});
    return;
  }
  if (!status.ok()) {
    warnings.push_back(
        {WarningKind::not_linearised,
         "there are no confidence intervals, because the best point cannot be linearised: " + status.reason(),
         summary.label});
    return;
  }
  for (std::size_t j = 0; j < summary.parameters.size(); ++j) {
    auto& estimate = summary.parameters[j];
    const auto& interval = found.parameters[j];
    estimate.assessed = true;
    estimate.identified = interval.identified;
    estimate.held = interval.held;
    estimate.straight = interval.straight;
    if (interval.identified && std::isfinite(interval.ci95)) estimate.ci95 = {interval.lower, interval.upper};
  }
  add_covariance(assembly, best.best.parameters, found, summary.covariance);
  add_state_differences(assembly, best.best.parameters, &found, summary);
  add_mesh_bias(assembly, best.best.parameters, found, work, summary, warnings);
  summary.curve_ci95 = std::move(found.curve_ci95);
  summary.identifiability = found.sentences();
}

/// Of the fitted channels that count, the one that the predictions are farthest from.
void add_deviation(const assembly::Assembly& assembly, const std::vector<double>& predictions, RunSummary& summary) {
  for (const auto& view : assembly.layout().channels) {
    const std::vector<double>& sd = view.sigma.rows.sd;
    if (!(view.weight > 0) || sd.empty()) continue;
    Deviation one{view.test, view.observable, view.unit};
    const auto rows = static_cast<double>(sd.size());
    for (std::size_t i = 0, k = 0; i < view.count; ++i) {
      if (!view.fitted[i]) continue;
      const double error = std::abs(predictions[view.offset + i] - view.measured[i]);
      one.mean += error / sd[k++] / rows;
      one.share += error / rows;
      one.largest = std::max(one.largest, std::abs(view.measured[i]));
    }
    std::vector<double> sorted = sd;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    one.sd = *middle;
    if (one.largest > 0) one.share /= one.largest;
    if (!summary.deviation || one.mean > summary.deviation->mean) summary.deviation = std::move(one);
  }
}

/// The size of the misfit. In a channel with unknown noise, the whole residual counts as misfit.
void add_size(const experiment::Experiment& experiment, const assembly::Assembly& assembly,
              const std::vector<double>& predictions, RunSummary& summary) {
  constexpr double hardly = 1e-9;  // of the range
  const std::vector<double> ranges = assembly::observable_ranges(assembly.layout(), experiment);
  std::vector<assembly::MisfitSize::Channel> channels;
  std::vector<double> residuals;
  for (std::size_t c = 0; c < ranges.size(); ++c) {
    const auto& view = assembly.layout().channels[c];
    assembly::NoiseModel noise = view.sigma.rows;
    if (!(view.weight > 0) || noise.sd.empty()) continue;
    if (!view.sigma.known()) {
      noise.sd.assign(noise.sd.size(), hardly * ranges[c]);
      noise.neighbour.clear();
    }
    double before = 0;
    for (std::size_t i = 0, k = 0; i < view.count; ++i) {
      if (!view.fitted[i]) continue;
      const double phi = noise.neighbour.empty() ? 0 : noise.neighbour[k];
      const double e = (predictions[view.offset + i] - view.measured[i]) / noise.sd[k++];
      residuals.push_back((e - phi * before) / std::sqrt(1 - phi * phi));
      before = e;
    }
    channels.push_back(
        {view.test, view.observable, view.unit, ranges[c], std::move(noise), assembly::counted_rows(view)});
  }
  if (channels.empty()) return;
  const assembly::MisfitSize size(std::move(channels));
  const auto free = static_cast<std::size_t>(
      std::count_if(summary.parameters.begin(), summary.parameters.end(),
                    [](const Estimate& one) { return one.at_bound == Estimate::Bound::none; }));
  const Eigen::Map<const Eigen::VectorXd> r(residuals.data(), static_cast<Eigen::Index>(residuals.size()));
  summary.size = size.of(r, free);
  summary.sizes = size.channels(r, free);
  if (!experiment.diagnosis || experiment.diagnosis->tolerance.empty()) return;
  std::vector<double> shares;
  for (const assembly::ChannelSize& one : summary.sizes) {
    const auto stated = assembly::stated_tolerance(experiment.diagnosis->tolerance, one);
    if (!stated) return;
    shares.push_back(*stated);
  }
  summary.tolerance = assembly::over_rows(summary.sizes, shares);
}

void add_quality(const experiment::Experiment& experiment, const assembly::Assembly& assembly,
                 const execution::RealisationResult& best, RunSummary& summary,
                 std::vector<execution::Warning>& warnings) {
  std::vector<double> predictions(assembly.layout().prediction_count);
  auto workspace = assembly.evaluator().make_workspace();
  if (!assembly.evaluator().predict(best.best.parameters, predictions, {}, *workspace).ok()) return;
  warn_of_neighbours(assembly, predictions, summary.label, warnings);
  for (const auto kind : {assembly::NoiseKind::stated, assembly::NoiseKind::estimated}) {
    auto& own = kind == assembly::NoiseKind::stated ? summary.misfit : summary.misfit_estimated;
    if (const assembly::Misfit found = misfit(assembly, kind, predictions); found.judged()) own = found;
  }
  add_deviation(assembly, predictions, summary);
  add_size(experiment, assembly, predictions, summary);
  for (auto& channel : assembly::quality(assembly, predictions)) {
    if (channel.fitted)
      summary.quality.push_back({channel.test, channel.observable, channel.unit, false, *channel.fitted, channel.over});
    if (channel.held_out)
      summary.quality.push_back(
          {channel.test, channel.observable, channel.unit, true, *channel.held_out, channel.over});
  }
}

void add_noise(const assembly::Assembly& assembly, RunSummary& summary) {
  summary.notes = assembly.layout().notes;
  for (const auto& channel : assembly.layout().channels) {
    std::vector<double> sd = channel.sigma.rows.sd;
    if (sd.empty()) continue;
    const auto middle = sd.begin() + static_cast<std::ptrdiff_t>(sd.size() / 2);
    std::nth_element(sd.begin(), middle, sd.end());
    summary.noise.push_back({channel.test, channel.observable, channel.unit, channel.sigma.origin, *middle});
  }
}

/// How far apart the curves of several realisations lie: one evaluation each, nothing beside the search.
void add_spread(const assembly::Assembly& assembly, const execution::RunResult& all, const plugins::LimitedWork& work,
                RunSummary& summary) {
  if (all.realisations.size() < 2) return;
  std::vector<double> predictions(assembly.layout().prediction_count);
  auto workspace = assembly.evaluator().make_workspace();
  std::size_t seen = 0;
  for (const auto& realisation : all.realisations) {
    if (!realisation.best.feasible()) continue;
    if (work.is_over()) {  // of some of them it would look narrower than it is
      summary.curve_lowest.clear();
      summary.curve_highest.clear();
      summary.notes.emplace_back("the curves of all realisations are left out: max_time was over");
      return;
    }
    if (!assembly.evaluator().predict(realisation.best.parameters, predictions, {}, *workspace).ok()) continue;
    if (seen++ == 0) summary.curve_lowest = summary.curve_highest = predictions;
    for (std::size_t i = 0; i < predictions.size(); ++i) {
      summary.curve_lowest[i] = std::min(summary.curve_lowest[i], predictions[i]);
      summary.curve_highest[i] = std::max(summary.curve_highest[i], predictions[i]);
    }
  }
}

}  // namespace

void estimate(const experiment::Experiment& experiment, const assembly::Assembly& assembly,
              const execution::RealisationResult& best, const execution::RunResult& all, RunSummary& summary,
              std::vector<execution::Warning>& warnings, plugins::Clock::time_point deadline) {
  evaluate_again(assembly, best, summary, warnings);
  add_parameters(assembly, best, all, summary);
  add_quality(experiment, assembly, best, summary, warnings);
  add_noise(assembly, summary);
  {
    const plugins::LimitedWork work("summary", deadline);
    add_identifiability(assembly, best, work, summary, warnings);
    add_spread(assembly, all, work, summary);
  }
  if (!summary.status.ok()) return;
  if (auto warning = transfer_warning(summary.label, summary.quality)) warnings.push_back(std::move(*warning));
}

}  // namespace tunica::comparison
