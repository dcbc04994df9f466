// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "experiment/blocks.hpp"
#include "experiment/limits.hpp"
#include "experiment/reader.hpp"

namespace tunica::experiment {
namespace {

Key<RunEntry> objective_key() {
  const auto schema = [] {
    const Json type = choice_schema("Its type.", names_in(objective_names));
    Json either = {{"description", "What is minimised (default standardised_quadratic)."}};
    either["anyOf"] = Json::array({type, object_schema("As an object.", Json{{"type", type}}, {"type"})});
    return either;
  };
  return {"objective", schema,
          [](const Node& node, RunEntry& run) {
            if (node.is_object()) node.allow_only({"type"}, "the objective");
            const Node type = node.is_object() ? node.require("type", "the objective") : node;
            run.objective = *text::value_of(objective_names, type.one_of(names_in(objective_names), "objective"));
          },
          [](const RunEntry& run) { return Json(text::code_of(objective_names, run.objective)); }};
}

Key<RunEntry> constraints_key() {
  Key<RunEntry> key{"constraints", constraints_schema,
                    [](const Node& node, RunEntry& run) { run.constraints = read_constraints(node); }};
  key.write = [](const RunEntry& run) {
    Json constraints = Json::array();
    for (const ConstraintEntry& constraint : run.constraints) constraints.push_back(Json::parse(constraint.json));
    return constraints;
  };
  return key;
}

Key<RunEntry> stop_key() {
  return {"stop", [] { return stop_block().schema(); },
          [](const Node& node, RunEntry& run) {
            run.stop = {};
            stop_block().read(node, run.stop);
          },
          [](const RunEntry& run) { return stop_block().write(run.stop); }};
}

Key<RunEntry> initial_key() {
  return {"initial",
          [] {
            return choice_schema(
                "Where a search begins: at the initial values (given, the default), or every realisation at a random "
                "point.",
                {"given", "random"});
          },
          [](const Node& node, RunEntry& run) {
            run.random_start = node.one_of({"given", "random"}, "start of a search") == "random";
          },
          [](const RunEntry& run) { return Json(run.random_start ? "random" : "given"); }};
}

Key<RunEntry> fewer_simulations_key() {
  return {"fewer_simulations", [] { return fewer_simulations_block().schema(); },
          [](const Node& node, RunEntry& run) {
            run.fewer_simulations = {};
            fewer_simulations_block().read(node, run.fewer_simulations);
          },
          [](const RunEntry& run) { return fewer_simulations_block().write(run.fewer_simulations); }};
}

std::vector<std::string> read_tests_of_run(const Node& node, const plugins::Catalogue& catalogue,
                                           std::vector<SharedParameter>& shared, Experiment& experiment) {
  std::vector<std::string> names;
  if (node.is_object()) {  // tests of this run's own
    for (const auto& [name, entry] : node.members("")) {
      const auto known = entry_names(experiment.tests);
      if (std::find(known.begin(), known.end(), name) != known.end())
        entry.fail(fmt::format("the test '{}' is already defined", name),
                   "Results carry the names of tests, so a test that differs needs another name; to use the same test, "
                   "list its name.");
      experiment.tests.push_back(
          read_test(name, entry, experiment.file.parent_path(), entries_to_name(experiment), catalogue, shared));
      names.push_back(name);
    }
  } else {
    for (const Node& child : node.elements("a list of test names, or an object of tests,")) {
      names.push_back(child.one_of(entry_names(experiment.tests), "test"));
      if (std::count(names.begin(), names.end(), names.back()) > 1)
        child.fail(fmt::format("the test '{}' appears twice in the list", names.back()),
                   "To count it twice, give it \"weight\": 2.");
    }
  }
  if (names.empty()) node.fail("the run has no tests", "Leave \"tests\" out to use all.");
  return names;
}

Key<RunEntry> tests_key(const plugins::Catalogue& catalogue, std::vector<SharedParameter>& shared,
                        Experiment& experiment) {
  const auto schema = [] {
    Json tests = {{"description", "The tests of this run: names, or tests of its own (default: all)."}};
    tests["anyOf"] = Json::array({list_schema("Names.", Json{{"type", "string"}}),
                                  named_entries_schema("Tests of its own.", reference("test"))});
    return tests;
  };
  return member_key("tests", schema, &RunEntry::tests,
                    [&](const Node& node) { return read_tests_of_run(node, catalogue, shared, experiment); });
}

Block<RunEntry> run_block(const plugins::Catalogue& catalogue, std::vector<SharedParameter>& shared,
                          Experiment& experiment) {
  std::vector<Key<RunEntry>> keys = {
      silent_at(name_key("model", "Name of a model; left out where every test names its own in layers.",
                         &RunEntry::model, entry_names(experiment.models)),
                ""),
      required(
          name_key("optimizer", "Name of an optimizer.", &RunEntry::optimizer, entry_names(experiment.optimizers))),
      count_key("realisations", "Repetitions with other seeds (default 1).", &RunEntry::realisations,
                "a whole number of realisations", 1, limits::realisations),
      tests_key(catalogue, shared, experiment)};
  for (Key<RunEntry>& key : keys_of_all_runs()) keys.push_back(std::move(key));
  return {"a run", "One calibration: a model, fitted by an optimizer.", std::move(keys)};
}

/// The run's model serves the tests that name no layers: it is there where there are such, and nowhere else.
void check_model_of_run(const Node& entry, const Experiment& experiment, const RunEntry& run) {
  const auto node = entry.find("model");
  const auto unlayered = std::find_if(run.tests.begin(), run.tests.end(),
                                      [&](const std::string& name) { return experiment.test(name).layers.empty(); });
  if (!node && unlayered != run.tests.end())
    entry.fail("the key 'model' is missing in a run",
               fmt::format("The test '{}' names no layers, so that it needs the model of the run.", *unlayered));
  if (node && unlayered == run.tests.end())
    node->fail(
        fmt::format("the model '{}' serves no test: every test of the run names its models in \"layers\"", run.model),
        "Leave \"model\" out.");
}

void check_held_out(const Node& entry, const Experiment& experiment, const RunEntry& run) {
  const auto any = [&](const auto& of_test) {
    return std::any_of(run.tests.begin(), run.tests.end(),
                       [&](const std::string& name) { return of_test(experiment.test(name)); });
  };
  const bool measured = any([](const TestEntry& test) { return test.measured; });
  if (measured && !any([](const TestEntry& test) { return test.measured && !test.hold_out.all; }))
    entry.fail("every test of the run is held out, so there is nothing to fit",
               "Set \"hold_out\" to false in at least one.");
}

}  // namespace

std::vector<Key<RunEntry>> keys_of_all_runs() {
  return {defined(objective_key()), defined(constraints_key()), defined(stop_key()), initial_key(),
          fewer_simulations_key()};
}

Json runs_schema(const plugins::Catalogue& catalogue) {
  Experiment none;
  std::vector<SharedParameter> shared;
  Json schema = list_schema("What to calibrate; the runs are compared.", run_block(catalogue, shared, none).schema());
  schema["minItems"] = 1;
  return schema;
}

Json write_runs(const Experiment& experiment, const plugins::Catalogue& catalogue) {
  Experiment none;
  std::vector<SharedParameter> shared;
  const Block<RunEntry> block = run_block(catalogue, shared, none);
  Json runs = Json::array();
  for (const RunEntry& run : experiment.runs) runs.push_back(block.write(run));
  return runs;
}

void read_runs(const Node& node, const RunEntry& defaults, const plugins::Catalogue& catalogue,
               std::vector<SharedParameter>& shared, Experiment& experiment) {
  const auto entries = node.elements("a list of runs, [ {\"model\": …, \"optimizer\": …}, … ],");
  if (entries.empty()) node.fail("no run is given", "Give at least one: {\"model\": …, \"optimizer\": …}.");
  std::uint64_t all_realisations = 0;
  for (const Node& entry : entries) {
    RunEntry run = defaults;
    run_block(catalogue, shared, experiment).read(entry, run);
    check_model_of_run(entry, experiment, run);
    check_held_out(entry, experiment, run);
    all_realisations += run.realisations;
    if (all_realisations > limits::all_realisations)
      entry.fail(fmt::format("with this run there are {} realisations, and an experiment has at most {}",
                             all_realisations, limits::all_realisations),
                 "Lower \"realisations\", or use several experiments.");
    experiment.runs.push_back(std::move(run));
  }
}

}  // namespace tunica::experiment
