// SPDX-License-Identifier: Apache-2.0
#include "assembly/builder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/channels.hpp"
#include "assembly/record.hpp"
#include "data/nearest.hpp"
#include "data/quantities.hpp"
#include "experiment/materials.hpp"
#include "text/units.hpp"
#include "tunica/error.hpp"

namespace tunica::assembly {
namespace {

/// The model's combinations as functions of the free values. A combination without a free argument is left out.
void add_combinations(const RunModel& model, bool several, std::vector<Combination>& found) {
  for (const Combination& combination : model.model->describe().combinations) {
    const std::string name = several ? fmt::format("{} ({})", model.name, combination.name) : combination.name;
    Combination free{name, combination.unit, {}, {}, combination.remedy};
    for (const Link& link : model.parameters.links) {
      const auto& arguments = combination.arguments;
      if (std::find(arguments.begin(), arguments.end(), link.position) == arguments.end()) continue;
      if (std::find(free.arguments.begin(), free.arguments.end(), link.index) == free.arguments.end()) {
        free.arguments.push_back(link.index);
      }
    }
    if (free.arguments.empty()) continue;
    free.value = [value = combination.value, vector = model.parameters](std::span<const double> values) {
      return value(vector.at(values));
    };
    found.push_back(std::move(free));
  }
}

/// Parameter names begin with the name of their test, or of their model if there are several.
void refuse_one_name_for_two(const std::vector<std::string>& models, const std::vector<std::string>& tests) {
  if (models.size() < 2) return;
  for (const std::string& model : models)
    if (std::find(tests.begin(), tests.end(), model) != tests.end())
      throw InputError(fmt::format(
          "a model and a test are both called '{}'; in a run with several models '{}.…' would name parameters of both. "
          "Rename one of them",
          model, model));
}

/// Notes the strips and the largest stretch that a test prescribes.
void add_stretches(const Test& test, const std::vector<Observable>& observables, const std::string& name,
                   std::size_t model, std::vector<Strip>& strips, double& largest) {
  for (const TestRows::Column& column : test.rows().abscissae) {
    const auto observable = std::find_if(observables.begin(), observables.end(), [&](const Observable& candidate) {
      return candidate.name == column.observable;
    });
    if (observable == observables.end() || observable->kind != Observable::Kind::stretch) continue;
    for (const double stretch : column.values) largest = std::max(largest, stretch);
    if (test.describe().free_strip_axis && column.observable == "stretch")
      strips.push_back({name,
                        model,
                        std::min<std::size_t>(*test.describe().free_strip_axis, 1),
                        {column.values.begin(), column.values.end()}});
  }
}

/// Bounds and held values outside the range that the model or test declares. A declared upper bound on a logarithmic
/// scale is typical of one tissue, and others may exceed it; a bound on the sign holds for all.
std::vector<std::string> out_of_range(const std::vector<FreeParameter>& free,
                                      const std::vector<FixedParameter>& fixed) {
  std::vector<std::string> warnings;
  for (const FreeParameter& p : free) {
    const bool sign = p.min < 0 && p.declared.min >= 0;
    if (!sign && (p.scale == Scale::log || (p.declared.contains(p.min) && p.declared.contains(p.max)))) continue;
    warnings.push_back(
        fmt::format("parameter '{}': its bounds {:g} … {:g}{} go beyond {:g} … {:g}, the declared range; values "
                    "outside may be meaningless",
                    p.name, p.min, p.max, text::unit_suffix(p.unit), p.declared.min, p.declared.max));
  }
  for (const FixedParameter& p : fixed)
    if (p.value != 0 && !p.declared.contains(p.value))  // 0 switches a part of a model off
      warnings.push_back(fmt::format("parameter '{}': held at {:g}{}, outside {:g} … {:g}, the declared range", p.name,
                                     p.value, text::unit_suffix(p.unit), p.declared.min, p.declared.max));
  return warnings;
}

/// If a test reads only some parameters of its model, only these may be free.
void refuse_unread(const RunTest& test, const RunModel& model) {
  const auto& reads = test.test->describe().reads;
  if (!reads) return;
  const auto& parameters = model.model->describe().parameters;
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  for (const std::string& name : *reads)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError(fmt::format("test '{}': it reads the parameter '{}', which the model '{}' does not have. {}",
                                   test.name, name, model.name, data::suggestion(name, names)));
  for (const Link& link : test.materials.links) {
    const std::string& name = names[link.position];
    if (std::find(reads->begin(), reads->end(), name) == reads->end())
      throw InputError(
          fmt::format("test '{}': the run searches for '{}', which the test does not read. It reads {}. Give it a "
                      "place in the test's files, or hold the parameter with \"fixed\"",
                      test.name, name, reads->empty() ? "none" : fmt::format("{}", fmt::join(*reads, ", "))));
  }
}

/// A force over the unloaded section gives the nominal stress. Other stress measures follow from it only if J = 1.
void refuse_converted_force(const experiment::TestEntry& entry, const std::vector<Observable>& observables,
                            const Model& model) {
  if (!model.describe().compressible || entry.data.stress_measure == "first_piola_kirchhoff") return;
  for (const auto& [name, column] : entry.data.columns)
    if (const auto quantity = data::quantity_named(name, observables);
        quantity && quantity->kind == data::Quantity::Kind::force)
      throw InputError(fmt::format(
          "test '{}': '{}' is a force, whose area changes by an unknown amount where the volume changes. Give "
          "\"stress_measure\": \"first_piola_kirchhoff\"",
          entry.name, name));
}

/// A size in the test's options that differs from the size by which the data reader divides forces or displacements.
void look_at_sizes(const experiment::TestEntry& entry, std::vector<std::string>& warnings) {
  const data::Sizes& specimen = entry.data.specimen.all;
  const auto compare = [&](const char* option, const char* size, const std::optional<double>& of_specimen) {
    if (!of_specimen || !entry.options.has(option)) return;
    const double simulated = entry.options.number(option);
    if (simulated == 0 || std::abs(simulated - *of_specimen) <= 1e-6 * *of_specimen) return;  // 0: not stated
    warnings.push_back(
        fmt::format("test '{}': its \"{}\" is {:g} mm, and the \"{}\" of the specimen, which the program divides by, "
                    "{:g} mm; correct "
                    "one of the two, unless they are two lengths",
                    entry.name, option, simulated, size, *of_specimen));
  };
  compare("width", "width", specimen.width);
  compare("length", "gauge_length", specimen.gauge_length);
}

std::string words_on_unstated(std::vector<std::string> channels) {
  constexpr std::size_t told = 3;
  const std::size_t more = channels.size() > told ? channels.size() - told : 0;
  channels.resize(channels.size() - more);
  return fmt::format("no noise is stated, so all rows of a channel weigh the same, by 1/σ²: {}{}",
                     fmt::join(channels, "; "), more > 0 ? fmt::format("; and {} more", more) : "");
}

}  // namespace

Parts Builder::build() {
  compose();
  bind();
  for (std::size_t t = 0; t < composed_.size(); ++t) add_test(t);
  add_priors();
  add_constraints();
  Layout& layout = parts_.layout;
  if (!unstated_.empty()) layout.notes.push_back(words_on_unstated(unstated_));
  layout.test_count = parts_.tests.size();
  layout.jacobian_is_exact =
      std::none_of(parts_.tests.begin(), parts_.tests.end(), [](const RunTest& test) { return test.differenced; });
  layout.derivatives_missing = std::any_of(parts_.tests.begin(), parts_.tests.end(), [](const RunTest& test) {
    return test.differenced && !test.test->describe().differencing;
  });
  layout.has_costly_tests =
      std::any_of(parts_.fitted.begin(), parts_.fitted.end(),
                  [this](const ChannelObjective& channel) { return parts_.tests[channel.test].costly; });
  return std::move(parts_);
}

void Builder::compose() {
  const std::vector<std::string> names = experiment_.models_of(run_);
  refuse_one_name_for_two(names, run_.tests);
  for (const std::string& name : names) {
    const std::string prefix = names.size() > 1 ? name + "." : "";
    const auto& findings = experiment_.model(name).findings;
    parts_.layout.findings.insert(parts_.layout.findings.end(), findings.begin(), findings.end());
    ComposedModel model = compose_model(experiment_.model(name), catalogue_, prefix);
    parts_.models.push_back({name, std::move(model.plugin), std::move(model.model), {}});
    slots_.push_back(std::move(model.slots));
  }
  for (const std::string& name : experiment_.states_of(run_)) add_state(experiment_.state(name), names.size());
  for (const std::string& name : run_.tests) {
    const experiment::TestEntry& entry = experiment_.test(name);
    composed_.push_back(
        compose_test(entry, catalogue_, entry.layers.empty() ? &experiment_.model(names.front()) : nullptr));
    slots_.push_back(composed_.back().slots);
  }
}

/// The models of a state have the parameters of the first state, except those that differ.
void Builder::add_state(const experiment::StateEntry& state, std::size_t models) {
  std::set<std::string> unread;
  for (const auto& [name, setting] : state.differs) unread.insert(name);
  for (std::size_t m = 0; m < models; ++m) {
    std::vector<Slot> slots =
        slots_in(state, parts_.models[m].name, slots_[m], m, settings_, parts_.layout.differing, unread);
    slots_.push_back(std::move(slots));
    RunModel other = parts_.models[m];
    other.name = fmt::format("{} ({})", other.name, state.name);
    other.state = state.name;
    parts_.models.push_back(std::move(other));
  }
  for (const std::string& name : unread)
    states_without_effect_.push_back(fmt::format(
        "the state '{}' says that '{}' differs, which changes nothing in a run of {}: no model of it has that "
        "parameter",
        state.name, name, fmt::join(experiment_.models_of(run_), " and ")));
}

void Builder::bind() {
  Binding binding = bind_parameters(slots_);
  vectors_ = std::move(binding.owners);
  for (std::size_t m = 0; m < parts_.models.size(); ++m) parts_.models[m].parameters = std::move(vectors_[m]);
  Layout& layout = parts_.layout;
  layout.parameters = std::move(binding.free);
  layout.fixed_parameters = std::move(binding.fixed);
  layout.warnings = out_of_range(layout.parameters, layout.fixed_parameters);
  std::move(states_without_effect_.begin(), states_without_effect_.end(), std::back_inserter(layout.warnings));
  const std::size_t models = experiment_.models_of(run_).size();
  for (const RunModel& model : parts_.models)
    if (model.state.empty()) add_combinations(model, models > 1, layout.combinations);
}

void Builder::add_test(std::size_t number) {
  Layout& layout = parts_.layout;
  const experiment::TestEntry& entry = experiment_.test(run_.tests[number]);
  ComposedTest& composed = composed_[number];
  const data::Dataset& dataset = composed.dataset;
  RunTest test;
  test.name = entry.name;
  test.test = std::move(composed.test);
  test.rows = dataset.count;
  test.channels = dataset.channels.size();
  test.offset = layout.prediction_count;
  test.own = std::move(vectors_[parts_.models.size() + number]);
  test.costly = test.test->describe().costly;
  assign_models(test, entry, parts_.models);
  if (test.layers.empty()) refuse_unread(test, parts_.models.front());
  chain_parameters(test, layout.parameters.size());
  const auto& observables = catalogue_.tests().at(entry.type).factory.observables;
  look_at_sizes(entry, layout.warnings);
  refuse_converted_force(entry, observables, *test.model);
  const auto in_its_state = std::find_if(parts_.models.begin(), parts_.models.end(),
                                         [&entry](const RunModel& model) { return model.state == entry.state; });
  add_stretches(*test.test, observables, entry.name, static_cast<std::size_t>(in_its_state - parts_.models.begin()),
                parts_.strips, parts_.largest_stretch);
  const std::vector<std::string> names = experiment_.models_of(run_);
  if (entry.layers.empty() && !names.empty() && experiment_.model(names.front()).options.has(experiment::material_key))
    if (std::string question =
            stiffness_question(entry, dataset, experiment_.model(names.front()).options.text(experiment::material_key));
        !question.empty())
      layout.warnings.push_back(std::move(question));
  for (const std::string& warning : dataset.warnings)
    layout.warnings.push_back(fmt::format("test '{}': {}", entry.name, warning));
  layout.findings.insert(layout.findings.end(), entry.findings.begin(), entry.findings.end());
  std::vector<data::Finding> findings = dataset.findings;
  look_at_unloaded_tube(entry, dataset, findings);
  look_at_noise(entry, dataset, findings);
  look_at_headers(entry, findings);
  for (const data::Finding& finding : findings)
    layout.findings.push_back({finding.kind, fmt::format("test '{}': {}", entry.name, finding.text)});
  for (std::size_t k = 0; k < dataset.sha256.size(); ++k) {
    const std::string file = k < entry.data.files.size() ? entry.data.files[k].filename().string() : entry.name;
    layout.data_hashes.push_back(fmt::format("{} sha256:{}", file, dataset.sha256[k]));
  }
  auto channels = measured_channels(entry, dataset, observables, test.offset);
  for (MeasuredChannel& channel : channels)
    channel.changes_volume = test.test->describe().volume == TestDescription::Volume::free;
  add_blocks(number, dataset, channels);
  layout.prediction_count += test.size();
  std::move(channels.begin(), channels.end(), std::back_inserter(layout.channels));
  parts_.tests.push_back(std::move(test));
}

void Builder::add_blocks(std::size_t number, const data::Dataset& dataset, std::vector<MeasuredChannel>& channels) {
  Layout& layout = parts_.layout;
  for (std::size_t k = 0; k < channels.size(); ++k) {
    MeasuredChannel& channel = channels[k];
    ChannelObjective fitted{number, {layout.residual_count, 0, 1, {}}, {}, {}, {}, {}};
    for (std::size_t row = 0; row < channel.count; ++row) {
      if (!channel.fitted[row]) continue;
      fitted.rows.push_back(channel.offset + row);
      fitted.measured.push_back(channel.measured[row]);
    }
    if (fitted.rows.empty()) continue;
    fitted.block.size = fitted.rows.size();
    const std::string where = fmt::format("test '{}', channel '{}'", channel.test, channel.observable);
    std::vector<std::string> unread;  // warnings of a noise that the objective does not read
    const bool reads = run_.objective == experiment::ObjectiveType::least_squares;
    // Changes while a stretch is held are not scatter.
    const bool over_time = channel.drawn_over.name == "time" && !dataset.time.empty();
    const auto along = over_time ? std::vector{std::pair(std::string("time"), dataset.time)} : dataset.abscissae;
    channel.sigma = channel_noise(dataset.channels[k], along, channel.fitted, where, reads ? layout.warnings : unread);
    if (reads && !channel.sigma.stated())
      unstated_.push_back(noise_words(channel.sigma, channel.test, channel.observable, channel.unit));
    scale_residuals(fitted, run_.objective, channel.weight, &channel.sigma.rows, where);
    layout.residual_count += fitted.block.size;
    layout.blocks.push_back(fitted.block);
    parts_.fitted.push_back(std::move(fitted));
  }
}

void Builder::add_priors() {
  Layout& layout = parts_.layout;
  for (std::size_t index = 0; index < layout.parameters.size(); ++index) {
    const FreeParameter& free = layout.parameters[index];
    if (!free.prior) continue;
    if (run_.objective == experiment::ObjectiveType::least_squares) {
      parts_.priors.push_back({index, free.prior->mean, free.prior->sd});
    } else {
      layout.warnings.push_back(
          fmt::format("the prior of '{}' is not used: a prior can be added only to 'least_squares', "
                      "which weighs data by their noise",
                      free.name));
    }
  }
  if (parts_.priors.empty()) return;
  layout.blocks.push_back({layout.residual_count, parts_.priors.size(), 1, ResidualBlock::Loss::quadratic});
  layout.residual_count += parts_.priors.size();
}

void Builder::add_constraints() {
  std::vector<const Model*> models;
  for (const RunModel& model : parts_.models) models.push_back(model.model.get());
  parts_.constraints = make_constraints(run_.constraints, models, parts_.strips);
  parts_.largest_stretch = std::max(parts_.largest_stretch, stated_range(run_.constraints));
}

}  // namespace tunica::assembly
