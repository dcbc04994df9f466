// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "experiment/blocks.hpp"
#include "experiment/limits.hpp"
#include "experiment/suggest.hpp"
#include "plugins/guarded.hpp"

namespace tunica::experiment {
namespace {

/// The parameters of the models as results name them, with and without the model's name, which runs of several models
/// have.
std::vector<Parameter> parameters_of(const std::vector<ModelEntry>& models, const plugins::Catalogue& catalogue) {
  std::vector<Parameter> all;
  const auto add = [&all](Parameter parameter, const std::string& prefix) {
    parameter.name = prefix + parameter.name;
    all.push_back(std::move(parameter));
  };
  for (const ModelEntry& entry : models)
    for (const std::string& of_model : {std::string(), entry.name + "."}) {
      const auto instance = plugins::create(catalogue.models().find(entry.type)->second, entry.options);
      for (const Parameter& parameter : instance->describe().parameters) add(parameter, of_model);
      for (const MechanismEntry& mechanism : entry.mechanisms)
        for (const Parameter& parameter :
             catalogue.mechanisms().find(mechanism.type)->second.factory.parameters_with(mechanism.options))
          add(parameter, of_model + mechanism.name() + ".");
    }
  return all;
}

Key<StateEntry> differing_key(const std::string& owner, const std::vector<Parameter>& known) {
  const auto schema = [] {
    Json differing = {{"description",
                       "Parameters that have a value of their own in this state, named as in results; what is silent "
                       "is as in the model."},
                      {"type", "object"},
                      {"minProperties", 1},
                      {"maxProperties", limits::entries}};
    differing["additionalProperties"] = reference("parameter");
    return differing;
  };
  const auto read = [=, &known](const Node& block, StateEntry& state) {
    for (const auto& [parameter, node] : block.members("an object with the parameters that differ")) {
      const auto found = std::find_if(known.begin(), known.end(),
                                      [&, &name = parameter](const Parameter& p) { return p.name == name; });
      if (found == known.end()) {
        std::vector<std::string> names;
        for (const Parameter& one : known) names.push_back(one.name);
        node.fail(fmt::format("unknown parameter '{}' of {}", excerpt(parameter), owner), suggestion(parameter, names));
      }
      node.expect_object("what the parameter is in this state, {} or {\"min\": …, \"max\": …},");
      state.differs.emplace(parameter, read_setting(node, parameter, found->unit));
    }
    if (state.differs.empty())
      block.fail(fmt::format("{} differs in no parameter", owner),
                 "Name those that differ, for example \"mu\": {}, or take the state out.");
  };
  return required<StateEntry>(
      {"parameters", schema, read, [](const StateEntry& state) { return write_parameters(state.differs); }});
}

Block<StateEntry> state_block(const std::string& owner, const std::vector<Parameter>& known) {
  return Block<StateEntry>(
             owner, "What differs in this state.",
             {silent_at(text_key("doc", "What was done to the specimen.", &StateEntry::doc, "a sentence on the state"),
                        ""),
              differing_key(owner, known)})
      .expecting("a state, {\"parameters\": {…}},");
}

StateEntry read_state(const std::string& name, const Node& entry, const std::vector<Parameter>& known) {
  entry.check_name(name, "state");
  StateEntry state{name, {}, {}};
  state_block(fmt::format("state '{}'", name), known).read(entry, state);
  return state;
}

}  // namespace

std::vector<StateEntry> read_states(const Node& node, const std::vector<ModelEntry>& models,
                                    const plugins::Catalogue& catalogue) {
  const std::vector<Parameter> known = parameters_of(models, catalogue);
  std::vector<StateEntry> states;
  for (const auto& [name, entry] : node.members("an object with one entry per state"))
    states.push_back(read_state(name, entry, known));
  return states;
}

void check_states(const Node& node, const Experiment& experiment) {
  for (const auto& [name, entry] : node.members("an object with one entry per state")) {
    const auto is_named = [wanted = name](const auto& other) { return other.name == wanted; };
    const auto is_mechanism = [&](const ModelEntry& model) {
      return std::any_of(model.mechanisms.begin(), model.mechanisms.end(),
                         [wanted = name](const MechanismEntry& one) { return one.name() == wanted; });
    };
    if (std::any_of(experiment.models.begin(), experiment.models.end(), is_named) ||
        std::any_of(experiment.models.begin(), experiment.models.end(), is_mechanism) ||
        std::any_of(experiment.tests.begin(), experiment.tests.end(), is_named))
      entry.fail(fmt::format("the state '{}' has the name of a model, a mechanism or a test", name),
                 "All begin the names of parameters: rename the state.");
    if (std::none_of(experiment.tests.begin(), experiment.tests.end(),
                     [wanted = name](const TestEntry& test) { return test.state == wanted; }))
      entry.fail(fmt::format("no test is in the state '{}'", name),
                 fmt::format("Write \"state\": \"{}\" in the tests that are, or take the state out.", name));
  }
}

Json write_state(const StateEntry& entry) { return state_block("", {}).write(entry); }

Json states_schema() {
  return named_entries_schema("States of the specimen, by name: tone, calcium, temperature, treatment.",
                              state_block("", {}).schema());
}

}  // namespace tunica::experiment
