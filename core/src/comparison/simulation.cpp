// SPDX-License-Identifier: Apache-2.0
#include "comparison/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <fmt/format.h>

#include "assembly/assembly.hpp"
#include "comparison/parameter_file.hpp"
#include "data/dataset.hpp"
#include "data/nearest.hpp"
#include "data/units.hpp"
#include "execution/evaluation_table.hpp"
#include "execution/files.hpp"
#include "text/csv.hpp"
#include "text/units.hpp"
#include "tunica/error.hpp"
#include "tunica/random.hpp"

namespace tunica::comparison {

namespace {

/// All tests with this model; what a run says beyond that does not enter predictions.
experiment::RunEntry all_tests_with(const experiment::Experiment& experiment, std::string model) {
  if (model.empty() && experiment.models.size() == 1) model = experiment.models.front().name;
  experiment::RunEntry run;
  bool needed = false;
  for (const auto& test : experiment.tests) {
    run.tests.push_back(test.name);
    needed = needed || test.layers.empty();
  }
  const std::string of_layers = experiment.model_name(run);
  if (needed) run.model = model;
  std::vector<std::string> models;
  for (const auto& entry : experiment.models) models.push_back(entry.name);
  if (needed && model.empty())
    throw InputError(
        fmt::format("--model is missing, and there are tests that name no layers. {}", data::suggestion("", models)));
  if (needed && std::find(models.begin(), models.end(), model) == models.end())
    throw InputError(
        fmt::format("--model {}: the experiment has no such model. {}", model, data::suggestion(model, models)));
  if (!needed && !model.empty() && model != of_layers)
    throw InputError(fmt::format(
        "--model {}: serves no test: every test names its models in \"layers\"; leave --model out, or give {}", model,
        of_layers));
  // A prediction needs neither noise nor range of the measured column, which may be a placeholder when a test is
  // planned; this objective asks for neither.
  run.objective = experiment::ObjectiveType::sum_of_norms;
  return run;
}

/// y (1 + R N(0, 1)); the generators are Boost's, whose numbers are the same with every standard library.
void add_noise(std::vector<double>& values, double relative, std::uint64_t seed) {
  if (relative == 0) return;
  boost::random::mt19937_64 generator(seed);
  boost::random::normal_distribution<double> normal;
  for (double& value : values) value *= 1 + relative * normal(generator);
}

const std::vector<double>* measured_column(const data::Dataset& dataset, const std::string& observable) {
  for (const auto& [name, values] : dataset.abscissae)
    if (name == observable) return &values;
  return observable == "time" && !dataset.time.empty() ? &dataset.time : nullptr;
}

/// Columns are written in the order a person reads them: what is prescribed, the time, what is measured.
int place(const std::vector<Observable>& observables, const std::string& name) {
  for (const auto& observable : observables)
    if (observable.name == name)
      return observable.role == Observable::Role::abscissa ? 0 : observable.role == Observable::Role::time ? 1 : 2;
  return 3;
}

}  // namespace

Subject subject_of(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                   const SimulationRequest& request) {
  const experiment::RunEntry run = all_tests_with(experiment, request.model);
  Subject subject;
  subject.model = experiment.model_name(run);
  subject.assembly = std::make_unique<assembly::Assembly>(experiment, run, catalogue);
  if (!request.run.empty() && !request.parameters)
    throw InputError("--run names a run of a result.json: name that with --parameters FILE");
  constexpr double too_much = 0.5;
  if (request.noise >= too_much)
    subject.warnings.push_back(fmt::format("a noise of {0:g} is {1:g} % of each value. Give {2:g} for {0:g} %",
                                           request.noise, 100 * request.noise, request.noise / 100));
  const auto& parameters = subject.assembly->layout().parameters;
  if (request.parameters)
    std::tie(subject.free, subject.source) =
        read_parameters(*request.parameters, subject.model, request.run, *subject.assembly);
  else
    for (const auto& parameter : parameters) subject.free.push_back(parameter.initial);
  if (!request.parameters) subject.source = "initial values of the experiment";
  subject.origin = subject.source;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const auto& parameter = parameters[j];
    const std::string unit = text::unit_suffix(parameter.unit);
    subject.origin += fmt::format("{}{} = {:.6g}{}", j == 0 ? ": " : ", ", parameter.name, subject.free[j], unit);
    if (!parameter.declared.contains(subject.free[j]))
      subject.warnings.push_back(
          fmt::format("{} = {:g}{} lies outside {:g} … {:g}, the range declared for it; the "
                      "predictions may mean nothing",
                      parameter.name, subject.free[j], unit, parameter.declared.min, parameter.declared.max));
  }
  return subject;
}

std::vector<SimulatedTable> simulate(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                                     const SimulationRequest& request) {
  return simulate(experiment, catalogue, request, subject_of(experiment, catalogue, request));
}

std::vector<SimulatedTable> simulate(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                                     const SimulationRequest& request, const Subject& subject) {
  const auto& assembly = *subject.assembly;
  const auto& free = subject.free;
  std::vector<double> predictions(assembly.layout().prediction_count);
  auto workspace = assembly.evaluator().make_workspace();
  const Status status = assembly.evaluator().predict(free, predictions, {}, *workspace);
  if (!status.ok())
    throw InputError(fmt::format("the model cannot be evaluated at these parameters: {}; give others with --parameters",
                                 status.reason()));

  std::vector<SimulatedTable> tables;
  for (const auto& test : experiment.tests) {
    const auto& observables = catalogue.tests().find(test.type)->second.factory.observables;
    const auto dataset = data::read_dataset(test.data, observables);
    auto& table = tables.emplace_back();
    table.test = test.name;
    auto sources = dataset.source_columns;
    std::stable_sort(sources.begin(), sources.end(), [&](const auto& a, const auto& b) {
      return place(observables, a.first) < place(observables, b.first);
    });
    for (const auto& [observable, source] : sources) {
      const auto& [column, source_unit] = source;
      const auto declared = std::find_if(observables.begin(), observables.end(),
                                         [&name = observable](const auto& o) { return o.name == name; });
      const std::string base = declared == observables.end() ? "1" : declared->unit;
      const std::string unit = source_unit.empty() ? base : source_unit;
      std::vector<double> values;
      const auto channel =
          std::find_if(assembly.layout().channels.begin(), assembly.layout().channels.end(),
                       [&, &name = observable](const auto& c) { return c.test == test.name && c.observable == name; });
      if (channel != assembly.layout().channels.end()) {
        const auto begin = predictions.begin() + static_cast<std::ptrdiff_t>(channel->offset);
        values.assign(begin, begin + static_cast<std::ptrdiff_t>(channel->count));
        // Of several tables, a row of one has nothing of the channels of another.
        for (std::size_t row = 0; !test.data.tables.empty() && row < values.size(); ++row)
          if (std::isnan(channel->measured[row])) values[row] = std::numeric_limits<double>::quiet_NaN();
        add_noise(values, request.noise,
                  derive_seed(request.seed, fmt::format("simulate {} {}", test.name, observable)));
      } else if (const auto* measured = measured_column(dataset, observable)) {
        values = *measured;
      } else {
        continue;
      }
      for (double& value : values) value = data::convert(value, base, unit);
      table.headers.push_back(fmt::format("{} [{}]", column, unit));
      if (declared != observables.end() && declared->role == Observable::Role::abscissa)
        table.prescribed.push_back(column);
      if (channel != assembly.layout().channels.end())
        for (const auto& [name, origin] : sources)
          if (name == channel->drawn_over.name) table.curves.push_back({column, origin.first});
      table.columns.push_back(std::move(values));
    }
  }
  return tables;
}

std::filesystem::path write_table(const std::filesystem::path& directory, const SimulatedTable& table) {
  std::string text;
  for (std::size_t c = 0; c < table.headers.size(); ++c) text += (c ? "," : "") + text::csv_cell(table.headers[c]);
  text += '\n';
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.front().size();
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      text += fmt::format("{}{}", c ? "," : "",
                          std::isnan(table.columns[c][row]) ? "" : fmt::format("{}", table.columns[c][row]));
    text += '\n';
  }
  auto file = directory / (table.test + ".csv");
  execution::write_atomically(file, text);
  return file;
}

}  // namespace tunica::comparison
