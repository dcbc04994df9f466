// SPDX-License-Identifier: Apache-2.0
#include "calibration/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "calibration/assembly_parts.hpp"
#include "calibration/composition.hpp"

namespace tunica::calibration {

std::vector<bool> fitted_rows(const experiment::TestEntry& entry, std::size_t count) {
  std::vector<bool> fitted(count, !entry.hold_out.all);
  if (entry.hold_out.all || !entry.hold_out.rows) return fitted;
  const data::RowRange& range = *entry.hold_out.rows;
  if (range.first >= count) {
    throw InputError(
        fmt::format("test '{}': hold_out starts at row {}, but only rows 0 … {} are used; choose rows among them",
                    entry.name, range.first, static_cast<std::ptrdiff_t>(count) - 1));
  }
  const std::size_t last = std::min(range.last.value_or(count), count);
  for (std::size_t row = range.first; row < last; row += std::max<std::size_t>(range.step, 1)) fitted[row] = false;
  return fitted;
}

namespace {

std::string unit_of(const std::string& name, const std::vector<Observable>& observables) {
  const auto found = std::find_if(observables.begin(), observables.end(),
                                  [&name](const Observable& candidate) { return candidate.name == name; });
  return found == observables.end() ? std::string() : found->unit;
}

/// What one test measured, channel by channel, its rows behind the predictions so far.
std::vector<ChannelView> views(const experiment::TestEntry& entry, const data::Dataset& dataset,
                               const std::vector<Observable>& observables, std::size_t offset) {
  std::vector<ChannelView> found;
  if (!entry.weights.empty() && entry.weights.size() != dataset.channels.size()) {
    throw InputError(fmt::format("test '{}': {} weights for {} fitted channels; give one number or one a channel",
                                 entry.name, entry.weights.size(), dataset.channels.size()));
  }
  for (std::size_t k = 0; k < dataset.channels.size(); ++k) {
    const data::Channel& channel = dataset.channels[k];
    ChannelView view;
    view.test = entry.name, view.observable = channel.observable, view.unit = channel.unit;
    view.offset = offset + k * dataset.count, view.count = dataset.count;
    view.measured = channel.values, view.noise = channel.noise;
    if (view.noise && channel.replicates.size() > 1) {
      const double root = std::sqrt(static_cast<double>(channel.replicates.size()));
      view.noise->absolute /= root, view.noise->relative /= root;
    }
    view.fitted = fitted_rows(entry, dataset.count);
    if (!entry.weights.empty()) view.weight = entry.weights[k];
    if (!dataset.abscissae.empty()) {
      const auto& [name, values] = dataset.abscissae.front();
      view.abscissa_name = name, view.abscissa = values, view.abscissa_unit = unit_of(name, observables);
      for (std::size_t other = 1; other < dataset.abscissae.size(); ++other) {
        const auto& [label, column] = dataset.abscissae[other];
        view.other_abscissae.emplace_back(fmt::format("{} [{}]", label, unit_of(label, observables)), column);
      }
    } else {
      view.abscissa_name = "row", view.abscissa_unit = "1";
      for (std::size_t row = 0; row < dataset.count; ++row) view.abscissa.push_back(static_cast<double>(row));
    }
    found.push_back(std::move(view));
  }
  return found;
}

/// The chain rule of one test, see BoundTest.
void chain(BoundTest& test, std::size_t free_count) {
  std::vector<std::optional<std::size_t>> first(free_count);
  const auto visit = [&](const Link& link, std::size_t slot) {
    if (first[link.index]) {
      test.sums.emplace_back(*first[link.index], slot);
    } else {
      first[link.index] = slot;
    }
  };
  for (const Link& link : test.materials.links) visit(link, link.position);
  for (const Link& link : test.own.links) visit(link, test.materials.values.size() + link.position);
  for (std::size_t index = 0; index < free_count; ++index) {
    if (!first[index]) {
      test.untouched.push_back(index);
    } else {
      // Differences fill rows in free order instead of slot order; there are never more of them than slots.
      test.columns.emplace_back(index, test.differenced ? test.columns.size() : *first[index]);
    }
  }
}

/// The model's combinations as functions of the free values; one without a free argument says nothing.
void add_combinations(const BoundModel& model, bool several, std::vector<Combination>& found) {
  const Bound& bound = model.parameters;
  for (const Combination& combination : model.model->describe().combinations) {
    const std::string name = several ? fmt::format("{} ({})", model.name, combination.name) : combination.name;
    Combination free{name, combination.unit, {}, {}, combination.remedy};
    for (const Link& link : bound.links) {
      const auto& arguments = combination.arguments;
      if (std::find(arguments.begin(), arguments.end(), link.position) == arguments.end()) continue;
      if (std::find(free.arguments.begin(), free.arguments.end(), link.index) == free.arguments.end()) {
        free.arguments.push_back(link.index);
      }
    }
    if (free.arguments.empty()) continue;
    free.value = [value = combination.value, bound](std::span<const double> values) {
      std::vector<double> all = bound.values;
      for (const Link& link : bound.links) all[link.position] = values[link.index];
      return value(all);
    };
    found.push_back(std::move(free));
  }
}

/// Gives a test its models: that of the run, or one a layer; layers that share one have a copy of its parameters each.
void give_models(BoundTest& test, const experiment::TestEntry& entry, const std::vector<BoundModel>& models) {
  const auto add = [&test](const BoundModel& model) {
    const std::size_t first = test.materials.values.size();
    const std::vector<double>& values = model.parameters.values;
    test.materials.values.insert(test.materials.values.end(), values.begin(), values.end());
    for (const Link& link : model.parameters.links) test.materials.links.push_back({first + link.position, link.index});
    test.differenced = test.differenced || !model.model->describe().parameter_derivatives;
    if (test.model_plugins.find(model.plugin) == std::string::npos)
      test.model_plugins += (test.model_plugins.empty() ? "" : ", ") + model.plugin;
  };
  if (entry.layers.empty()) add(models.front());
  for (const experiment::LayerEntry& layer : entry.layers) {
    const auto named = std::find_if(models.begin(), models.end(),
                                    [&layer](const BoundModel& candidate) { return candidate.name == layer.model; });
    test.layers.push_back(named->model.get());
    add(*named);
  }
  test.model = test.layers.empty() ? models.front().model.get() : test.layers.front();
}

/// Names of several models and of tests begin the names of parameters.
void refuse_one_name_for_two(const std::vector<std::string>& models, const std::vector<std::string>& tests) {
  if (models.size() < 2) return;
  for (const std::string& model : models)
    if (std::find(tests.begin(), tests.end(), model) != tests.end())
      throw InputError(fmt::format(
          "a model and a test are called '{}', and in a run with several models '{}.…' would be the name of "
          "parameters of both; rename one of them",
          model, model));
}

/// Notes the strips and the largest stretch that a test prescribes.
void add_stretches(const Test& test, const std::vector<Observable>& observables, const std::string& name,
                   std::vector<Strip>& strips, double& largest) {
  for (const TestRows::Column& column : test.rows().abscissae) {
    const auto observable = std::find_if(observables.begin(), observables.end(), [&](const Observable& candidate) {
      return candidate.name == column.observable;
    });
    if (observable == observables.end() || observable->kind != Observable::Kind::stretch) continue;
    for (const double stretch : column.values) largest = std::max(largest, stretch);
    if (test.describe().free_strip_axis && column.observable == "stretch")
      strips.push_back({name,
                        0,
                        std::min<std::size_t>(*test.describe().free_strip_axis, 1),
                        {column.values.begin(), column.values.end()}});
  }
}

/// Bounds, and values that are held, outside of what the model or test declares. On a logarithmic scale an upper bound
/// is a habit of its tissue, which others may exceed; a sign is not.
std::vector<std::string> out_of_range(const std::vector<FreeParameter>& free,
                                      const std::vector<FixedParameter>& fixed) {
  std::vector<std::string> warnings;
  const auto unit = [](const std::string& name) { return name == "1" ? "" : ' ' + name; };
  for (const FreeParameter& p : free) {
    const bool sign = p.min < 0 && p.declared.min >= 0;
    if (!sign && (p.scale == Scale::log || (p.declared.contains(p.min) && p.declared.contains(p.max)))) continue;
    warnings.push_back(
        fmt::format("parameter '{}': its bounds {:g} … {:g}{} go beyond {:g} … {:g}, the range declared for it: values "
                    "there may mean nothing",
                    p.name, p.min, p.max, unit(p.unit), p.declared.min, p.declared.max));
  }
  for (const FixedParameter& p : fixed)
    if (p.value != 0 && !p.declared.contains(p.value))  // 0 switches a part of a model off
      warnings.push_back(fmt::format("parameter '{}': held at {:g}{}, outside {:g} … {:g}, the range declared for it",
                                     p.name, p.value, unit(p.unit), p.declared.min, p.declared.max));
  return warnings;
}

Map map_of(const FreeParameter& free) {
  if (free.scale == Scale::linear) return {free.min, free.max, 0, 0, false};
  return {free.min, free.max, std::log(free.min), std::log(free.max / free.min), true};
}

}  // namespace

void Assembly::WorkspaceDeleter::operator()(Workspace* workspace) const { delete workspace; }

Assembly::Assembly(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                   const plugins::Catalogue& catalogue)
    : parts_(std::make_unique<Parts>()) {
  Parts& parts = *parts_;
  const std::vector<std::string> names = experiment.models_of(run);
  const bool several = names.size() > 1;
  refuse_one_name_for_two(names, run.tests);
  std::vector<std::vector<Slot>> slots;
  for (const std::string& name : names) {
    ComposedModel model = compose_model(experiment.model(name), catalogue, several ? name + "." : "");
    parts.models.push_back({name, std::move(model.plugin), std::move(model.model), {}});
    slots.push_back(std::move(model.slots));
  }
  std::vector<ComposedTest> tests;
  for (const std::string& name : run.tests) {
    tests.push_back(compose_test(experiment.test(name), catalogue));
    slots.push_back(tests.back().slots);
  }
  Binding binding = bind_parameters(slots);
  for (std::size_t m = 0; m < names.size(); ++m) parts.models[m].parameters = std::move(binding.owners[m]);
  parts.free = std::move(binding.free), parts.fixed = std::move(binding.fixed);
  std::transform(parts.free.begin(), parts.free.end(), std::back_inserter(parts.maps), map_of);
  parts.warnings = out_of_range(parts.free, parts.fixed);
  for (const BoundModel& model : parts.models) add_combinations(model, several, parts.combinations);

  for (std::size_t t = 0; t < tests.size(); ++t) {
    const experiment::TestEntry& entry = experiment.test(run.tests[t]);
    const data::Dataset& dataset = tests[t].dataset;
    BoundTest test;
    test.name = entry.name, test.plugin = std::move(tests[t].plugin), test.test = std::move(tests[t].test);
    test.rows = dataset.count, test.channels = dataset.channels.size(), test.offset = parts.prediction_count;
    test.own = std::move(binding.owners[names.size() + t]);
    give_models(test, entry, parts.models);
    test.costly = test.test->describe().costly;
    chain(test, parts.free.size());
    const auto& observables = catalogue.tests().at(entry.type).factory.observables;
    add_stretches(*test.test, observables, entry.name, parts.strips, parts.largest_stretch);
    for (const std::string& warning : dataset.warnings) {
      parts.warnings.push_back(fmt::format("test '{}': {}", entry.name, warning));
    }
    for (std::size_t k = 0; k < dataset.sha256.size(); ++k) {
      const std::string file = k < entry.data.files.size() ? entry.data.files[k].filename().string() : entry.name;
      parts.data_hashes.push_back(fmt::format("{} sha256:{}", file, dataset.sha256[k]));
    }
    auto channels = views(entry, dataset, observables, test.offset);
    for (std::size_t k = 0; k < channels.size(); ++k) {
      const ChannelView& view = channels[k];
      FittedChannel fitted{t, {parts.residual_count, 0, 1, {}}, {}, {}, {}, {}};
      for (std::size_t row = 0; row < view.count; ++row) {
        if (!view.fitted[row]) continue;
        fitted.rows.push_back(view.offset + row), fitted.measured.push_back(view.measured[row]);
      }
      if (fitted.rows.empty()) continue;
      fitted.block.size = fitted.rows.size();
      const std::string where = fmt::format("test '{}', channel '{}'", view.test, view.observable);
      NoiseModel noise;
      if (run.objective == experiment::ObjectiveType::least_squares) {
        noise = noise_model(dataset.channels[k], view.abscissa, view.fitted, where, parts.warnings);
      }
      scale_residuals(fitted, run.objective, view.weight, &noise, where);
      parts.residual_count += fitted.block.size;
      parts.blocks.push_back(fitted.block);
      parts.fitted.push_back(std::move(fitted));
    }
    parts.prediction_count += test.size();
    std::move(channels.begin(), channels.end(), std::back_inserter(parts.channels));
    parts.tests.push_back(std::move(test));
  }

  for (std::size_t index = 0; index < parts.free.size(); ++index) {
    const FreeParameter& free = parts.free[index];
    if (!free.prior) continue;
    if (run.objective == experiment::ObjectiveType::least_squares) {
      parts.priors.push_back({index, free.prior->mean, free.prior->sd});
    } else {
      parts.warnings.push_back(
          fmt::format("the prior of '{}' is not used: only 'least_squares' weighs data by their noise, "
                      "so that a prior can be added to it",
                      free.name));
    }
  }
  if (!parts.priors.empty()) {
    parts.blocks.push_back({parts.residual_count, parts.priors.size(), 1, ResidualBlock::Loss::quadratic});
    parts.residual_count += parts.priors.size();
  }

  std::vector<const Model*> models;
  for (const BoundModel& model : parts.models) models.push_back(model.model.get());
  parts.constraints = make_constraints(run.constraints, models, parts.strips);
  for (const auto& [model, constraint] : parts.constraints) parts.constraint_count += constraint->count();
  parts.largest_stretch = std::max(parts.largest_stretch, stated_range(run.constraints));
}

Assembly::~Assembly() = default;

const std::vector<FreeParameter>& Assembly::parameters() const { return parts_->free; }
const std::vector<FixedParameter>& Assembly::fixed_parameters() const { return parts_->fixed; }
const std::vector<ChannelView>& Assembly::channels() const { return parts_->channels; }
std::size_t Assembly::test_count() const { return parts_->tests.size(); }
std::size_t Assembly::prediction_count() const { return parts_->prediction_count; }
const std::vector<ResidualBlock>& Assembly::blocks() const { return parts_->blocks; }
std::size_t Assembly::residual_count() const { return parts_->residual_count; }
const std::vector<std::string>& Assembly::warnings() const { return parts_->warnings; }
const std::vector<std::string>& Assembly::data_hashes() const { return parts_->data_hashes; }
const std::vector<Combination>& Assembly::combinations() const { return parts_->combinations; }

std::size_t Assembly::model_count() const { return parts_->models.size(); }
const std::string& Assembly::model_name(std::size_t model) const { return parts_->models[model].name; }
const Model& Assembly::model(std::size_t model) const { return *parts_->models[model].model; }
const std::vector<Strip>& Assembly::strips() const { return parts_->strips; }
double Assembly::largest_stretch() const { return parts_->largest_stretch; }

std::vector<double> Assembly::model_parameters(std::size_t model, std::span<const double> free) const {
  const Bound& bound = parts_->models[model].parameters;
  std::vector<double> all = bound.values;
  for (const Link& link : bound.links) all[link.position] = free[link.index];
  return all;
}

bool Assembly::jacobian_is_exact() const {
  return std::none_of(parts_->tests.begin(), parts_->tests.end(),
                      [](const BoundTest& test) { return test.differenced; });
}

bool Assembly::has_costly_tests() const {
  return std::any_of(parts_->fitted.begin(), parts_->fitted.end(),
                     [&](const FittedChannel& channel) { return parts_->tests[channel.test].costly; });
}

Assembly::WorkspacePointer Assembly::make_workspace() const { return WorkspacePointer(new Workspace(*parts_)); }

void Assembly::from_unit(std::span<const double> x, std::span<double> free) const {
  for (std::size_t j = 0; j < parts_->maps.size(); ++j) {
    const Map& map = parts_->maps[j];
    const double value =
        map.logarithmic ? std::exp(map.log_min + x[j] * map.log_span) : map.min + x[j] * (map.max - map.min);
    free[j] = x[j] <= 0 ? map.min : x[j] >= 1 ? map.max : std::clamp(value, map.min, map.max);  // not out by rounding
  }
}

void Assembly::to_unit(std::span<const double> free, std::span<double> x) const {
  for (std::size_t j = 0; j < parts_->maps.size(); ++j) {
    const Map& map = parts_->maps[j];
    const double unit =
        map.logarithmic ? (std::log(free[j]) - map.log_min) / map.log_span : (free[j] - map.min) / (map.max - map.min);
    x[j] = std::clamp(unit, 0.0, 1.0);
  }
}

std::vector<double> Assembly::initial_unit() const {
  std::vector<double> initial, x(parts_->free.size());
  for (const FreeParameter& parameter : parts_->free) initial.push_back(parameter.initial);
  to_unit(initial, x);
  return x;
}

}  // namespace tunica::calibration
