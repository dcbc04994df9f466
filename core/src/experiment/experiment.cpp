// SPDX-License-Identifier: Apache-2.0
#include "experiment/experiment.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "data/csv.hpp"
#include "experiment/limits.hpp"
#include "experiment/parse.hpp"
#include "experiment/reader.hpp"
#include "plugins/default_options.hpp"
#include "tunica/error.hpp"

namespace tunica::experiment {
namespace {

// Names were checked when the file was read; asking for another one is a bug of the caller.
template <class Entry>
const Entry& named(const std::vector<Entry>& entries, std::string_view name) {
  for (const Entry& entry : entries)
    if (entry.name == name) return entry;
  throw std::out_of_range(fmt::format("the experiment has no entry '{}'", name));
}

}  // namespace

const ModelEntry& Experiment::model(std::string_view wanted) const { return named(models, wanted); }
const TestEntry& Experiment::test(std::string_view wanted) const { return named(tests, wanted); }
const StateEntry& Experiment::state(std::string_view wanted) const { return named(states, wanted); }
const OptimizerEntry& Experiment::optimizer(std::string_view wanted) const { return named(optimizers, wanted); }

std::vector<std::string> Experiment::models_of(const RunEntry& run) const {
  std::vector<std::string> names;
  if (!run.model.empty()) names.push_back(run.model);
  for (const std::string& used : run.tests)
    for (const LayerEntry& layer : test(used).layers)
      if (std::find(names.begin(), names.end(), layer.model) == names.end()) names.push_back(layer.model);
  return names;
}

std::vector<std::string> Experiment::states_of(const RunEntry& run) const {
  std::vector<std::string> names;
  for (const std::string& used : run.tests)
    if (const std::string& state = test(used).state;
        !state.empty() && std::find(names.begin(), names.end(), state) == names.end())
      names.push_back(state);
  return names;
}

Experiment measured_only(Experiment experiment) {
  for (RunEntry& run : experiment.runs)
    std::erase_if(run.tests, [&](const std::string& name) { return !experiment.test(name).measured; });
  std::erase_if(experiment.runs, [](const RunEntry& run) { return run.tests.empty(); });
  std::erase_if(experiment.tests, [](const TestEntry& test) { return !test.measured; });
  if (experiment.tests.empty())
    throw InputError(
        "no test has measured values, so there is nothing to diagnose. Map a measured quantity in "
        "\"columns\"");
  return experiment;
}

std::string Experiment::model_name(const RunEntry& run) const {
  return run.model.empty() ? fmt::format("{}", fmt::join(models_of(run), "+")) : run.model;
}

Experiment read_experiment(const std::filesystem::path& file, const plugins::Catalogue& catalogue, Purpose purpose) {
  return parse_experiment(data::read_bytes(file, limits::file_bytes), file, catalogue, purpose);
}

namespace {

std::vector<OptimizerEntry> default_optimizers(const plugins::Catalogue& catalogue) {
  const auto* const refiner = catalogue.refiner();
  if (refiner == nullptr)
    throw InputError(
        "no loaded plugin provides an optimizer that refines a fit; give the experiment \"optimizers\", or "
        "--plugin-path a folder that holds 'ceres_lm'");
  return {{"lm", refiner->factory.type, plugins::default_options(refiner->factory.options)}};
}

/// A run of every model over all tests; one alone where every test names its models in layers.
void add_default_runs(const RunDefaults& defaults, Experiment& experiment) {
  RunEntry run;
  run.optimizer = experiment.optimizers.front().name;
  run.tests = defaults.tests;
  const bool layered = std::all_of(experiment.tests.begin(), experiment.tests.end(),
                                   [](const TestEntry& test) { return !test.layers.empty(); });
  if (layered) experiment.runs.push_back(run);
  for (const ModelEntry& model : experiment.models) {
    if (layered) break;
    run.model = model.name;
    experiment.runs.push_back(run);
  }
  experiment.only_predicts = true;
}

}  // namespace

Experiment parse_experiment(std::string text, const std::filesystem::path& file, const plugins::Catalogue& catalogue,
                            Purpose purpose) {
  const JsonDocument document(file, std::move(text));
  const Node root(document);
  if (!root.is_object()) root.fail_expected("an experiment, { \"format\": 1, … },");
  // The version first: where it differs, other messages would mislead.
  const Node format = root.require("format", "the experiment file");
  if (!format.is_number() || format.number("") != 1)
    format.fail(fmt::format("found format {} where 1 is expected", format.dumped()),
                "This version of tunica reads format 1 only.");
  root.allow_only({"$schema",          "format",     "name",       "seed",
                   "models",           "states",     "tests",      "objective",
                   "constraints",      "optimizers", "stop",       "initial",
                   "paired_starts",    "runs",       "on_failure", "fewer_simulations",
                   "keep_evaluations", "analysis",   "diagnosis",  "discovery"},
                  "the experiment file");
  Experiment experiment;
  experiment.file = file;
  experiment.name = file.stem().string();
  if (const auto node = root.find("$schema")) node->text("the name of a schema");
  if (const auto node = root.find("name")) experiment.name = node->text("a name");
  if (const auto node = root.find("seed")) experiment.seed = node->count("a whole number", 0);
  std::vector<SharedParameter> shared;
  const Node models = root.require("models", "the experiment file");
  for (const auto& [name, entry] : models.members("an object with one entry per model"))
    experiment.models.push_back(read_model(name, entry, catalogue, shared));
  if (experiment.models.empty())
    models.fail("no model is given", "Give at least one, for example \"gho\": {\"type\": \"gho\"}.");
  if (const auto node = root.find("states")) experiment.states = read_states(*node, experiment.models, catalogue);
  const Node tests = root.require("tests", "the experiment file");
  for (const auto& [name, entry] : tests.members("an object with one entry per test"))
    experiment.tests.push_back(
        read_test(name, entry, file.parent_path(), entries_to_name(experiment), catalogue, shared));
  if (experiment.tests.empty()) tests.fail("no test is given", "Give at least one, with its data.");
  const bool without_runs = purpose == Purpose::prediction && !root.find("runs");
  experiment.optimizers = without_runs && !root.find("optimizers")
                              ? default_optimizers(catalogue)
                              : read_optimizers(root.require("optimizers", "the experiment file"), catalogue);
  RunDefaults defaults;
  defaults.tests = entry_names(experiment.tests);
  if (const auto node = root.find("objective")) defaults.objective = read_objective(*node);
  if (const auto node = root.find("constraints")) defaults.constraints = read_constraints(*node);
  if (const auto node = root.find("stop")) defaults.stop = read_stop(*node);
  if (const auto node = root.find("initial")) defaults.random_start = read_initial(*node);
  if (const auto node = root.find("paired_starts")) experiment.paired_starts = node->flag("true or false");
  if (const auto node = root.find("fewer_simulations")) defaults.fewer_simulations = read_fewer_simulations(*node);
  if (const auto node = root.find("keep_evaluations")) experiment.kept_evaluations = read_kept_evaluations(*node);
  if (const auto node = root.find("on_failure")) read_on_failure(*node, experiment);
  if (without_runs)
    add_default_runs(defaults, experiment);
  else
    read_runs(root.require("runs", "the experiment file"), defaults, catalogue, shared, experiment);
  check_shared(shared);
  if (const auto node = root.find("states")) check_states(*node, experiment);
  if (const auto node = root.find("analysis")) read_analysis(*node, experiment);
  if (const auto node = root.find("diagnosis")) experiment.diagnosis = read_diagnosis(*node, experiment, catalogue);
  if (const auto node = root.find("discovery")) experiment.discovery = read_discovery(*node, experiment);
  experiment.input_json = write_input(experiment, catalogue);
  return experiment;
}

}  // namespace tunica::experiment
