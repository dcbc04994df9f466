// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "data/quantities.hpp"
#include "experiment/blocks.hpp"
#include "experiment/limits.hpp"

namespace tunica::experiment {
namespace {

using Role = Observable::Role;

std::vector<double> read_weights(const Node& entry, std::size_t channels, std::string_view owner) {
  const auto node = entry.find("weight");
  if (!node) return std::vector<double>(channels, 1.0);
  const auto weight = [](const Node& at) {
    const double value = at.number("a weight");
    if (value < 0)
      at.fail(fmt::format("the weight is {}", value), "Weights are not negative; 0 leaves the channel out of the fit.");
    return value;
  };
  if (!node->is_array()) return std::vector<double>(channels, weight(*node));
  std::vector<double> weights;
  for (const Node& child : node->elements("")) weights.push_back(weight(child));
  if (weights.size() != channels)
    node->fail(fmt::format("found {} weights for the {} of {}", weights.size(),
                           channels == 1 ? "one mapped channel" : fmt::format("{} mapped channels", channels), owner),
               "Give one number for all, or one per channel in the order of \"columns\".");
  return weights;
}

Key<TestEntry> weight_key() {
  const auto schema = [] {
    const Json one = {{"type", "number"}, {"minimum", 0}};
    Json list = {{"type", "array"}, {"items", one}};
    Json either = {
        {"description", "Weight in the objective: one, or one per channel in the order of `columns` (default 1)."}};
    either["anyOf"] = Json::array({one, std::move(list)});
    return either;
  };
  return {"weight", schema, {}, [](const TestEntry& test) { return Json(test.weights); }};
}

Key<TestEntry> hold_out_key() {
  const auto schema = [] {
    Json either = {
        {"description",
         "Kept out of the fit, predicted and scored: all rows, or a range of the rows used (default false)."}};
    either["anyOf"] = Json::array({Json{{"type", "boolean"}}, reference("row_range")});
    return either;
  };
  const auto read = [](const Node& node, TestEntry& test) {
    if (node.is_flag())
      test.hold_out.all = node.flag("");
    else if (node.is_text())
      test.hold_out.rows = read_row_range(node);
    else
      node.fail_expected("true, false or a row range such as \"200:240\"");
  };
  const auto write = [](const TestEntry& test) {
    return test.hold_out.rows ? Json(write_row_range(*test.hold_out.rows)) : Json(test.hold_out.all);
  };
  return {"hold_out", schema, read, write};
}

Key<TestEntry> state_key(const std::string& owner, const std::vector<std::string>& states) {
  const auto read = [=](const Node& node, TestEntry& test) {
    if (states.empty())
      node.fail(fmt::format("{} names a state, and the experiment has no \"states\"", owner),
                "Add them, for example \"states\": {\"relaxed\": {\"parameters\": {\"mu\": {}}}}.");
    test.state = node.one_of(states, "state");
  };
  return {"state", [] { return reference("state_name"); }, read,
          [](const TestEntry& test) { return test.state.empty() ? Json() : Json(test.state); }};
}

/// One table, or several whose rows follow one another.
Key<TestEntry> data_key(const TestFactory& factory) {
  const auto schema = [&factory] {
    const Json one = reference("data_" + factory.type);
    Json list = {{"type", "array"}, {"items", one}, {"minItems", 1}, {"maxItems", limits::entries}};
    Json either = {{"description", "The measured data: one table, or several whose rows follow one another."}};
    either["anyOf"] = Json::array({one, std::move(list)});
    return either;
  };
  return required<TestEntry>(
      {"data", schema, {}, [&factory](const TestEntry& test) { return write_data(test.data, factory.observables); }});
}

Block<TestEntry> test_block(const std::string& owner, const std::string& doc, const TestFactory& factory,
                            const std::vector<std::string>& states, const plugins::Catalogue& catalogue) {
  std::vector<Key<TestEntry>> keys = keys_of_plugin<TestEntry>(factory.type, factory.options);
  const bool own_state = std::any_of(factory.options.begin(), factory.options.end(),
                                     [](const Option& option) { return option.name == "state"; });
  if (factory.layered) keys.push_back(layers_key());
  if (!own_state) keys.push_back(state_key(owner, states));
  keys.push_back(data_key(factory));
  keys.push_back(defined(weight_key()));
  keys.push_back(defined(hold_out_key()));
  keys.push_back({"parameters",
                  [&factory] { return parameters_schema(factory.parameters); },
                  {},
                  [](const TestEntry& test) { return write_parameters(test.parameters); }});
  keys.push_back({"mechanisms",
                  [&] { return test_mechanisms_schema(factory.type, catalogue); },
                  {},
                  [&catalogue](const TestEntry& test) { return write_mechanisms(test.mechanisms, catalogue); }});
  return {owner, doc, std::move(keys)};
}

}  // namespace

TestEntry read_test(const std::string& name, const Node& entry, const std::filesystem::path& folder,
                    const NamedEntries& named, const plugins::Catalogue& catalogue,
                    std::vector<SharedParameter>& shared) {
  entry.expect_object("a test, {\"type\": …},");
  entry.check_name(name, "test");
  const std::string owner = fmt::format("test '{}'", name);
  const std::string type = entry.require("type", owner).one_of(names_of(catalogue.tests()), "test type");
  const TestFactory& factory = catalogue.tests().find(type)->second.factory;
  TestEntry test;
  test.name = name;
  test.type = type;
  test.layers = read_layers(entry, type, named.models, catalogue);
  const Block<TestEntry> block = test_block(owner, "", factory, named.states, catalogue);
  block.allow_only(entry);
  test.options = default_options(entry, factory.options, owner);
  block.read(entry, test);
  test.folder = std::filesystem::absolute(folder.empty() ? "." : folder);
  if (test.options.has("folder")) {  // absolute from here on, so that a copy of the file elsewhere means the same
    test.folder = (test.folder / test.options.text("folder")).lexically_normal();
    test.options.set("folder", test.folder.string());
  }
  test.findings = bare_angles(entry, factory.options, factory.parameters, owner);
  test.parameters = read_mentioned_parameters(entry, factory.parameters, owner, shared);
  test.mechanisms = read_test_mechanisms(entry, type, owner, catalogue, shared, test.findings);
  test.data = read_data(entry.require("data", owner), factory.observables, owner, folder);
  for (data::Finding& finding : odd_sizes(entry, test, factory.options, owner))
    test.findings.push_back(std::move(finding));
  const auto channels = std::count_if(test.data.columns.begin(), test.data.columns.end(), [&](const auto& column) {
    return data::quantity_named(column.first, factory.observables)->observable->role == Role::channel;
  });
  test.measured = channels > 0;
  test.weights = read_weights(entry, static_cast<std::size_t>(channels), owner);
  // Every saved input contains weights of 1, so they carry no information.
  if (test.hold_out.all && std::any_of(test.weights.begin(), test.weights.end(), [](double one) { return one != 1; }))
    entry.require("weight", owner)
        .fail(fmt::format("\"weight\" changes nothing in {}, which is held out", owner),
              "Leave one of \"weight\" and \"hold_out\" out.");
  return test;
}

Json write_test(const TestEntry& entry, const plugins::Catalogue& catalogue) {
  return test_block("", "", catalogue.tests().find(entry.type)->second.factory, {}, catalogue).write(entry);
}

void define_tests(Json& definitions, const plugins::Catalogue& catalogue) {
  definitions["state_name"] = text_schema("Name of the state that the specimen was in (default: that of the models).");
  definitions["test"] = by_type("test", names_of(catalogue.tests()), "A test and its data.");
  for (const auto& [type, entry] : catalogue.tests()) {
    const TestFactory& factory = entry.factory;
    const Block<TestEntry> block =
        test_block("", described(factory.doc, factory.reference, entry.plugin), factory, {}, catalogue);
    block.define(definitions);
    definitions["data_" + type] = table_schema(factory.observables);
    definitions["test_" + type] = block.schema();
  }
}

}  // namespace tunica::experiment
