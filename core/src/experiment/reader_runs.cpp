// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "experiment/enum_names.hpp"
#include "experiment/limits.hpp"
#include "experiment/reader.hpp"
#include "experiment/suggest.hpp"
#include "experiment/tolerance_text.hpp"

namespace tunica::experiment {
namespace {

template <class Enumeration, std::size_t count>
Enumeration read_choice(const Node& node, const text::Codes<Enumeration, count>& table, std::string_view noun) {
  return *text::value_of(table, node.one_of(names_in(table), noun));
}

// The sub-critical factor h of the stability constraint: a number, or a table over stretch.
StabilityFactor read_stability_factor(const Node& node) {
  constexpr std::string_view expected = "a number from 0 to 1, or a table [[stretch, h], …] with rising stretches,";
  const auto factor = [&](const Node& h) {
    if (!h.is_number() || h.number("") < 0 || h.number("") > 1) h.fail_expected(expected);
    return h.number("");
  };
  if (!node.is_array()) return {{1, factor(node)}};
  const auto rows = node.elements(expected);
  if (rows.empty()) node.fail_expected(expected);
  StabilityFactor table;
  for (const Node& row : rows) {
    if (!row.is_array() || row.size() != 2) row.fail_expected("a pair [stretch, h]");
    const double stretch = row.element(0).number("a stretch");
    if (!(stretch > (table.empty() ? 0 : table.back().first)))
      row.element(0).fail(
          fmt::format("the stretch {} does not lie above {}", stretch, table.empty() ? 0 : table.back().first),
          "Stretches of the table are positive and rise.");
    table.emplace_back(stretch, factor(row.element(1)));
  }
  return table;
}

void read_transverse_stability(const Node& entry, ConstraintEntry& constraint) {
  if (const auto h = entry.find("h")) constraint.h = read_stability_factor(*h);
  if (const auto range = entry.find("range")) {
    constexpr std::string_view expected = "two stretches [from, to], 0 < from < to,";
    if (!range->is_array() || range->size() != 2) range->fail_expected(expected);
    constraint.range = {range->element(0).number(expected), range->element(1).number(expected)};
    if (!(constraint.range->first > 0 && constraint.range->first < constraint.range->second))
      range->fail(fmt::format("the range goes from {} to {}", constraint.range->first, constraint.range->second),
                  "Expected two stretches [from, to], 0 < from < to.");
  }
  if (const auto points = entry.find("points"))
    constraint.points = points->count("a whole number of stretches", 2, limits::stability_points);
  if (const auto directions = entry.find("directions")) {
    static const std::vector<std::string> names = {"circumferential", "axial"};
    constraint.directions = {false, false};
    const auto add = [&](const Node& name) {
      constraint.directions[name.one_of(names, "direction") == names[0] ? 0 : 1] = true;
    };
    if (directions->is_text())
      add(*directions);
    else
      for (const Node& name : directions->elements("a direction, or a list of them,")) add(name);
  }
}

std::vector<std::string> read_test_list(const Node& node, const std::filesystem::path& folder,
                                        const plugins::Catalogue& catalogue, std::vector<SharedParameter>& shared,
                                        Experiment& experiment) {
  std::vector<std::string> names;
  if (node.is_object()) {  // tests of this run's own
    for (const auto& [name, entry] : node.members("")) {
      const auto known = entry_names(experiment.tests);
      if (std::find(known.begin(), known.end(), name) != known.end())
        entry.fail(fmt::format("the test '{}' is already defined", name),
                   "Results carry the names of tests, so a test that differs needs another name; to use the same test, "
                   "list its name.");
      experiment.tests.push_back(read_test(name, entry, folder, entries_to_name(experiment), catalogue, shared));
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

/// The run's model serves the tests that name no layers: it is there where there are such, and nowhere else.
void read_model_of_run(const Node& entry, const Experiment& experiment, RunEntry& run) {
  const auto node = entry.find("model");
  if (node) run.model = node->one_of(entry_names(experiment.models), "model");
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

}  // namespace

ObjectiveType read_objective(const Node& node) {
  if (!node.is_object()) return read_choice(node, objective_names, "objective");
  node.allow_only({"type"}, "the objective");
  return read_choice(node.require("type", "the objective"), objective_names, "objective");
}

std::vector<ConstraintEntry> read_constraints(const Node& node) {
  std::vector<ConstraintEntry> constraints;
  for (const Node& entry : node.elements("a list of constraints, [ {\"type\": …}, … ],")) {
    entry.expect_object("a constraint, {\"type\": …},");
    ConstraintEntry constraint;
    constraint.type =
        entry.require("type", "a constraint").one_of({"transverse_stability", "admissible_parameters"}, "constraint");
    constraint.json = entry.dumped();
    constraint.pointer = entry.place();
    const std::string owner = fmt::format("the constraint '{}'", constraint.type);
    if (constraint.type == "transverse_stability") {
      entry.allow_only({"type", "h", "range", "points", "directions"}, owner);
      read_transverse_stability(entry, constraint);
    } else {
      entry.allow_only({"type"}, owner);
    }
    constraints.push_back(std::move(constraint));
  }
  return constraints;
}

FewerSimulations read_fewer_simulations(const Node& node) {
  node.allow_only({"early_end", "guide"}, "\"fewer_simulations\"");
  FewerSimulations fewer;
  if (const auto early_end = node.find("early_end")) fewer.early_end = early_end->flag("true or false");
  if (const auto guide = node.find("guide")) fewer.guide = guide->flag("true or false");
  return fewer;
}

bool read_initial(const Node& node) { return node.one_of({"given", "random"}, "start of a search") == "random"; }

KeptEvaluations read_kept_evaluations(const Node& node) {
  return read_choice(node, kept_evaluations_names, "set of evaluations");
}

void read_on_failure(const Node& node, Experiment& experiment) {
  if (!node.is_object()) {
    experiment.on_failure = read_choice(node, on_failure_names, "failure policy");
    return;
  }
  node.allow_only({"policy", "max_rate"}, "\"on_failure\"");
  if (const auto policy = node.find("policy"))
    experiment.on_failure = read_choice(*policy, on_failure_names, "failure policy");
  if (const auto rate = node.find("max_rate")) {
    experiment.max_failure_rate = rate->quantity("1", "a share of failed evaluations");
    if (!(experiment.max_failure_rate >= 0 && experiment.max_failure_rate <= 1))
      rate->fail(fmt::format("the share of failed evaluations is {}", experiment.max_failure_rate),
                 "Expected a number from 0 to 1, or a percentage such as \"50 %\".");
    if (experiment.on_failure == OnFailure::stop)
      rate->fail("\"max_rate\" changes nothing beside \"policy\": \"stop\", which ends at the first failure",
                 "Leave one of the two out.");
  }
}

void read_runs(const Node& node, const RunDefaults& defaults, const plugins::Catalogue& catalogue,
               std::vector<SharedParameter>& shared, Experiment& experiment) {
  const auto entries = node.elements("a list of runs, [ {\"model\": …, \"optimizer\": …}, … ],");
  if (entries.empty()) node.fail("no run is given", "Give at least one: {\"model\": …, \"optimizer\": …}.");
  std::uint64_t all_realisations = 0;
  for (const Node& entry : entries) {
    entry.allow_only({"model", "optimizer", "realisations", "initial", "tests", "objective", "constraints", "stop",
                      "fewer_simulations"},
                     "a run");
    RunEntry run;
    run.optimizer = entry.require("optimizer", "a run").one_of(entry_names(experiment.optimizers), "optimizer");
    if (const auto child = entry.find("realisations"))
      run.realisations = child->count("a whole number of realisations", 1, limits::realisations);
    const auto tests = entry.find("tests"), objective = entry.find("objective"),
               constraints = entry.find("constraints"), stop = entry.find("stop"), initial = entry.find("initial");
    run.random_start = initial ? read_initial(*initial) : defaults.random_start;
    run.tests =
        tests ? read_test_list(*tests, experiment.file.parent_path(), catalogue, shared, experiment) : defaults.tests;
    read_model_of_run(entry, experiment, run);
    run.objective = objective ? read_objective(*objective) : defaults.objective;
    run.constraints = constraints ? read_constraints(*constraints) : defaults.constraints;
    run.stop = stop ? read_stop(*stop) : defaults.stop;
    const auto fewer = entry.find("fewer_simulations");
    run.fewer_simulations = fewer ? read_fewer_simulations(*fewer) : defaults.fewer_simulations;
    const auto any = [&](const auto& of_test) {
      return std::any_of(run.tests.begin(), run.tests.end(),
                         [&](const std::string& name) { return of_test(experiment.test(name)); });
    };
    const bool measured = any([](const TestEntry& test) { return test.measured; });
    if (measured && !any([](const TestEntry& test) { return test.measured && !test.hold_out.all; }))
      entry.fail("every test of the run is held out, so there is nothing to fit",
                 "Set \"hold_out\" to false in at least one.");
    all_realisations += run.realisations;
    if (all_realisations > limits::all_realisations)
      entry.fail(fmt::format("with this run there are {} realisations, and an experiment has at most {}",
                             all_realisations, limits::all_realisations),
                 "Lower \"realisations\", or use several experiments.");
    experiment.runs.push_back(std::move(run));
  }
}

namespace {

double read_alpha(const Node& node) {
  const double alpha = node.number("a significance level");
  if (!(alpha >= 0.0001 && alpha <= 0.5))
    node.fail(
        fmt::format("the significance level is {}", alpha),
        "Expected a number from 0.0001 to 0.5, for example 0.05. The draws of noise are too few for a smaller one.");
  return alpha;
}

std::vector<std::string> read_groups(const Node& node) {
  std::vector<std::string> groups;
  for (const Node& name : node.elements("a list of groups of causes"))
    groups.push_back(name.one_of(cause_groups, "group"));
  const auto physical = [](const std::string& group) { return group != "file"; };
  if (std::none_of(groups.begin(), groups.end(), physical))
    node.fail("no group of physical causes is in the list",
              "Name \"material\", \"rig\" or both, or leave \"groups\" out to try every one.");
  return groups;
}

double read_wrong_files(const Node& node) {
  const double share = node.number("a share of files");
  if (!(share >= 0.0001 && share <= 0.9))
    node.fail(fmt::format("the share of files is {}", share), "Expected a number from 0.0001 to 0.9, for example 0.1.");
  return share;
}

/// A share of the range for all observables, or for each a share or a quantity in its unit.
std::vector<std::pair<std::string, std::string>> read_tolerance(const Node& node, const Experiment& experiment,
                                                                const plugins::Catalogue& catalogue) {
  constexpr const char* expected = "a share of the range, as \"2 %\"";
  const auto share = [](const Node& one) {
    const std::string text = one.text(expected);
    try {
      return tolerance_text(text, "\"tolerance\"");
    } catch (const InputError&) {
      one.fail(fmt::format("'{}' is no tolerance", text),
               "Give a share of the range above 0 and up to 50 %, as \"2 %\".");
    }
  };
  if (node.is_text()) return {{"", share(node)}};
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& [observable, one] : node.members(expected)) {
    const std::string text = one.text(expected);
    if (text.ends_with('%')) {
      all.emplace_back(observable, share(one));
      continue;
    }
    std::string unit;
    for (const TestEntry& test : experiment.tests)
      for (const Observable& known : catalogue.tests().at(test.type).factory.observables)
        if (known.name == observable) unit = known.unit;
    if (unit.empty())
      one.fail(fmt::format("no test of the file has the observable '{}'", observable),
               "Name one that the tests have, or give one share of the range for all.");
    if (!(one.quantity(unit, "a quantity with a unit, or a share of the range as \"2 %\"") > 0))
      one.fail("a tolerance is above 0", "Give a share of the range, as \"2 %\", or a quantity with a unit.");
    all.emplace_back(observable, text);
  }
  return all;
}

}  // namespace

DiagnosisEntry read_diagnosis(const Node& node, const Experiment& experiment, const plugins::Catalogue& catalogue) {
  node.allow_only({"model", "optimizer", "alpha", "mechanisms", "admissibility", "groups", "wrong_files", "tolerance"},
                  "\"diagnosis\"");
  DiagnosisEntry diagnosis;
  if (const auto child = node.find("model")) diagnosis.model = child->one_of(entry_names(experiment.models), "model");
  if (const auto child = node.find("optimizer"))
    diagnosis.optimizer = child->one_of(entry_names(experiment.optimizers), "optimizer");
  if (const auto child = node.find("admissibility")) diagnosis.admissibility = child->flag("true or false");
  if (const auto child = node.find("alpha")) diagnosis.alpha = read_alpha(*child);
  if (const auto child = node.find("groups")) diagnosis.groups = read_groups(*child);
  if (const auto child = node.find("wrong_files")) diagnosis.wrong_files = read_wrong_files(*child);
  if (const auto child = node.find("tolerance")) diagnosis.tolerance = read_tolerance(*child, experiment, catalogue);
  const auto child = node.find("mechanisms");
  if (!child) return diagnosis;
  if (child->is_text()) {
    const std::string& set = child->text("");
    if (set != "all")
      child->fail(fmt::format("unknown set of mechanisms '{}'", set),
                  fmt::format("Give \"all\" or a list, for example [\"{}\"].", set));
    diagnosis.all_mechanisms = true;
    return diagnosis;
  }
  const auto names = child->elements("\"all\" or a list of mechanism names");
  if (names.empty()) child->fail("the list is empty", "Leave \"mechanisms\" out, or give \"all\", to try every one.");
  for (const Node& name : names)
    diagnosis.mechanisms.push_back(name.one_of(names_of(catalogue.mechanisms()), "mechanism"));
  return diagnosis;
}

DiscoveryEntry read_discovery(const Node& node, const Experiment& experiment) {
  node.allow_only({"model", "from_nothing", "invariants", "laws", "most_terms", "most_parameters", "alpha"},
                  "\"discovery\"");
  DiscoveryEntry discovery;
  if (const auto child = node.find("model")) discovery.model = child->one_of(entry_names(experiment.models), "model");
  if (const auto child = node.find("from_nothing")) discovery.from_nothing = child->flag("true or false");
  if (const auto child = node.find("alpha")) discovery.alpha = read_alpha(*child);
  const auto read_words = [&](const char* key, const std::vector<std::string>& known, const char* noun) {
    std::vector<std::string> words;
    const auto child = node.find(key);
    if (!child) return words;
    for (const Node& word : child->elements("a list of names")) words.push_back(word.one_of(known, noun));
    if (words.empty()) child->fail("the list is empty", fmt::format("Leave \"{}\" out to try every one.", key));
    return words;
  };
  discovery.invariants = read_words("invariants", discovery_invariants, "invariant");
  discovery.laws = read_words("laws", discovery_laws, "law");
  const auto read_count = [&](const char* key, std::int64_t most) -> std::optional<std::size_t> {
    const auto child = node.find(key);
    if (!child) return std::nullopt;
    const std::int64_t count = child->integer("a whole number");
    if (count < 1 || count > most)
      child->fail(fmt::format("{} is {}", key, count), fmt::format("Give a whole number from 1 to {}.", most));
    return static_cast<std::size_t>(count);
  };
  discovery.most_terms = read_count("most_terms", 6);
  discovery.most_parameters = read_count("most_parameters", 20);
  return discovery;
}

}  // namespace tunica::experiment
