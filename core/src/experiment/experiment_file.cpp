// SPDX-License-Identifier: Apache-2.0
// The experiment file as a whole: its keys, which reader, schema and input.json follow.
#include <algorithm>

#include <fmt/format.h>

#include "data/csv.hpp"
#include "experiment/blocks.hpp"
#include "experiment/limits.hpp"
#include "experiment/parse.hpp"
#include "plugins/default_options.hpp"

namespace tunica::experiment {
namespace {

using FileKey = Key<Experiment>;

/// What the parts of a file share while they are read.
struct Reading {
  const plugins::Catalogue& catalogue;
  bool searches = true;    ///< false: a prediction, which may do without optimizers and runs
  RunEntry defaults = {};  ///< what a run has that does not state it
  std::vector<SharedParameter> shared = {};
};

template <class Entry, class Write>
Json write_entries(const std::vector<Entry>& entries, Write write) {
  Json json;
  for (const Entry& entry : entries) json[entry.name] = write(entry);
  return json;
}

FileKey format_key() {
  return required<Experiment>({"format",
                               [] {
                                 return Json{{"description", "Version of the file format."}, {"const", 1}};
                               },
                               {},
                               [](const Experiment&) { return Json(1); }});
}

FileKey models_key(Reading& reading) {
  const auto& catalogue = reading.catalogue;
  const auto schema = [&catalogue] {
    return named_entries_schema("The models to calibrate, by name.",
                                by_type("model", names_of(catalogue.models()), "A model."));
  };
  const auto read = [&reading](const Node& models, Experiment& experiment) {
    for (const auto& [name, entry] : models.members("an object with one entry per model"))
      experiment.models.push_back(read_model(name, entry, reading.catalogue, reading.shared));
    if (experiment.models.empty())
      models.fail("no model is given", "Give at least one, for example \"gho\": {\"type\": \"gho\"}.");
  };
  const auto write = [&catalogue](const Experiment& experiment) {
    return write_entries(experiment.models, [&](const ModelEntry& entry) { return write_model(entry, catalogue); });
  };
  return required<Experiment>({"models", schema, read, write});
}

FileKey states_key(const plugins::Catalogue& catalogue) {
  return {"states", states_schema,
          [&catalogue](const Node& node, Experiment& experiment) {
            experiment.states = read_states(node, experiment.models, catalogue);
          },
          [](const Experiment& experiment) { return write_entries(experiment.states, write_state); }};
}

FileKey tests_key(Reading& reading) {
  const auto read = [&reading](const Node& tests, Experiment& experiment) {
    for (const auto& [name, entry] : tests.members("an object with one entry per test"))
      experiment.tests.push_back(read_test(name, entry, experiment.file.parent_path(), entries_to_name(experiment),
                                           reading.catalogue, reading.shared));
    if (experiment.tests.empty()) tests.fail("no test is given", "Give at least one, with its data.");
    reading.defaults.tests = entry_names(experiment.tests);
  };
  const auto write = [&catalogue = reading.catalogue](const Experiment& experiment) {
    return write_entries(experiment.tests, [&](const TestEntry& entry) { return write_test(entry, catalogue); });
  };
  return required<Experiment>(
      {"tests", [] { return named_entries_schema("The tests to fit, by name.", reference("test")); }, read, write});
}

FileKey optimizers_key(Reading& reading) {
  const auto& catalogue = reading.catalogue;
  return {"optimizers", [] { return named_entries_schema("The optimizers to use, by name.", reference("optimizer")); },
          [&catalogue](const Node& node, Experiment& experiment) {
            experiment.optimizers = read_optimizers(node, catalogue);
          },
          [&catalogue](const Experiment& experiment) {
            return write_entries(experiment.optimizers,
                                 [&](const OptimizerEntry& entry) { return write_optimizer(entry, catalogue); });
          },
          reading.searches};
}

/// A key of runs at the top level: it holds for all that do not state it. What every run has is written here too, so
/// that a run that is added or changed by hand has it as well.
FileKey for_all_runs(const Key<RunEntry>& of_run, Reading& reading) {
  FileKey key{of_run.name, of_run.schema,
              [&reading, of_run](const Node& node, Experiment&) { of_run.read(node, reading.defaults); },
              [of_run](const Experiment& experiment) {
                Json first;
                for (const RunEntry& run : experiment.runs) {
                  Json value = of_run.write(run);
                  if (first.is_null()) first = value;
                  if (value != first) return Json();
                }
                return first;
              }};
  key.defined = of_run.defined;
  return key;
}

FileKey runs_key(Reading& reading) {
  return {"runs", [&catalogue = reading.catalogue] { return runs_schema(catalogue); },
          [&reading](const Node& node, Experiment& experiment) {
            read_runs(node, reading.defaults, reading.catalogue, reading.shared, experiment);
          },
          [&catalogue = reading.catalogue](const Experiment& experiment) { return write_runs(experiment, catalogue); },
          reading.searches};
}

/// A policy, or an object with its limit.
FileKey on_failure_key() {
  const Block<Experiment> block = on_failure_block();
  const FileKey policy = block.keys().front();
  const auto schema = [=] {
    Json either = {{"description", "What to do when an evaluation fails (default penalise)."}};
    either["anyOf"] = Json::array({policy.schema(), block.schema()});
    return either;
  };
  const auto read = [=](const Node& node, Experiment& experiment) {
    if (node.is_object())
      block.read(node, experiment);
    else
      policy.read(node, experiment);
  };
  return {"on_failure", schema, read, [=](const Experiment& experiment) { return block.write(experiment); }};
}

FileKey analysis_key() {
  return {"analysis", [] { return analysis_block({}).schema(); },
          [](const Node& node, Experiment& experiment) { analysis_block(experiment).read(node, experiment.analysis); },
          [](const Experiment& experiment) {
            Json json = analysis_block({}).write(experiment.analysis);
            return json.empty() ? Json() : json;
          }};
}

FileKey diagnosis_key(const plugins::Catalogue& catalogue) {
  return {"diagnosis", [&catalogue] { return diagnosis_block({}, catalogue).schema(); },
          [&catalogue](const Node& node, Experiment& experiment) {
            diagnosis_block(experiment, catalogue).read(node, experiment.diagnosis.emplace());
          },
          [&catalogue](const Experiment& experiment) {
            return experiment.diagnosis ? diagnosis_block({}, catalogue).write(*experiment.diagnosis) : Json();
          }};
}

FileKey discovery_key() {
  return {"discovery", [] { return discovery_block({}).schema(); },
          [](const Node& node, Experiment& experiment) {
            discovery_block(experiment).read(node, experiment.discovery.emplace());
          },
          [](const Experiment& experiment) {
            return experiment.discovery ? discovery_block({}).write(*experiment.discovery) : Json();
          }};
}

Block<Experiment> file_block(Reading& reading) {
  const auto& catalogue = reading.catalogue;
  std::vector<FileKey> keys = {
      {"$schema", [] { return text_schema("This schema, for editors."); },
       [](const Node& node, Experiment&) { node.text("the name of a schema"); }},
      format_key(),
      text_key("name", "Name of the experiment (default: the file's).", &Experiment::name, "a name"),
      count_key("seed", "Root of all random numbers (default 1).", &Experiment::seed, "a whole number", 0),
      models_key(reading),
      states_key(catalogue),
      tests_key(reading),
      optimizers_key(reading)};
  for (const Key<RunEntry>& key : keys_of_all_runs()) keys.push_back(for_all_runs(key, reading));
  const std::vector<FileKey> others = {
      silent_at(flag_key("paired_starts",
                         "Whether runs of the same parameters and bounds begin their searches at the same points "
                         "(default false).",
                         &Experiment::paired_starts),
                false),
      runs_key(reading),
      on_failure_key(),
      code_key("keep_evaluations",
               "Which rows evaluations.csv keeps once the results are written: all, or improvements of the best point "
               "only (default all).",
               &Experiment::kept_evaluations, kept_evaluations_names, "set of evaluations"),
      analysis_key(),
      diagnosis_key(catalogue),
      discovery_key()};
  keys.insert(keys.end(), others.begin(), others.end());
  return {"the experiment file",
          "Written by `tunica schema` from what the loaded plugins declare. Quantities are numbers in base units (kPa, "
          "mm, mN, s, deg) or text with a unit, as in \"3.71 mm\".",
          std::move(keys)};
}

std::vector<OptimizerEntry> default_optimizers(const plugins::Catalogue& catalogue) {
  const auto* const refiner = catalogue.refiner();
  if (refiner == nullptr)
    throw InputError(
        "no loaded plugin provides an optimizer that refines a fit; give the experiment \"optimizers\", or "
        "--plugin-path a folder that holds 'ceres_lm'");
  return {{"lm", refiner->factory.type, plugins::default_options(refiner->factory.options), {}}};
}

/// A run of every model over all tests; one alone where every test names its models in layers.
void add_default_runs(const RunEntry& defaults, Experiment& experiment) {
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
  const bool without_runs = purpose == Purpose::prediction && !root.find("runs");
  Experiment experiment;
  experiment.file = file;
  experiment.name = file.stem().string();
  if (without_runs && !root.find("optimizers")) experiment.optimizers = default_optimizers(catalogue);
  Reading reading{catalogue, !without_runs};
  file_block(reading).read(root, experiment);
  if (without_runs) add_default_runs(reading.defaults, experiment);
  check_shared(reading.shared);
  if (const auto node = root.find("states")) check_states(*node, experiment);
  experiment.input_json = write_input(experiment, catalogue);
  return experiment;
}

Experiment read_experiment(const std::filesystem::path& file, const plugins::Catalogue& catalogue, Purpose purpose) {
  return parse_experiment(data::read_bytes(file, limits::file_bytes), file, catalogue, purpose);
}

std::string write_input(const Experiment& experiment, const plugins::Catalogue& catalogue) {
  Reading reading{catalogue};
  return file_block(reading).write(experiment).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string compose_schema(const plugins::Catalogue& catalogue) {
  Reading reading{catalogue};
  const Block<Experiment> block = file_block(reading);
  Json definitions = Json::object();
  definitions["parameter"] = parameter_schema();
  define_data(definitions);
  block.define(definitions);
  define_optimizers(definitions, catalogue);
  define_models(definitions, catalogue);
  define_tests(definitions, catalogue);
  define_mechanisms(definitions, catalogue);
  Json schema = Json::object();
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = "tunica experiment file";
  schema.update(block.schema());
  schema["definitions"] = std::move(definitions);
  return schema.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tunica::experiment
