// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/blocks.hpp"
#include "experiment/limits.hpp"

namespace tunica::experiment {
namespace {

const char* stage_word(Stage stage) {
  return stage == Stage::test ? "tests" : stage == Stage::data ? "data" : "models";
}

bool acts_on_model(const MechanismFactory& mechanism) { return mechanism.stage < Stage::test; }

/// The parameters of a mechanism with these options, which it may refuse.
std::vector<Parameter> parameters_of(const Node& node, const MechanismFactory& factory, const Options& options) {
  try {
    return factory.parameters_with(options);
  } catch (const InputError& problem) {
    node.fail(fmt::format("the mechanism '{}' refuses its options", factory.id), problem.what());
  }
}

Block<MechanismEntry> mechanism_block(const std::string& owner, const std::string& doc,
                                      const MechanismFactory& factory) {
  std::vector<Key<MechanismEntry>> keys = keys_of_plugin<MechanismEntry>(factory.id, factory.options);
  const auto read_as = [&factory](const Node& node) {
    const std::string& as = node.text("a name for the parameters of this mechanism");
    node.check_name(as, "mechanism");
    if (!factory.native.empty())
      node.fail(fmt::format("the mechanism '{}' is a parameter that a test has once", factory.id), "Take \"as\" out.");
    return as;
  };
  keys.insert(
      keys.begin() + 1,
      silent_at(
          member_key(
              "as", [] { return text_schema("Name of its parameters, where several of a type stand side by side."); },
              &MechanismEntry::as, read_as),
          ""));
  keys.push_back({"parameters",
                  [&factory] {
                    Json schema = parameters_schema(factory.parameters);
                    if (factory.parameters_of) schema["additionalProperties"] = reference("parameter");
                    return schema;
                  },
                  {},
                  [](const MechanismEntry& entry) { return write_parameters(entry.parameters); }});
  return {owner, doc, std::move(keys)};
}

/// The mechanisms of one list, checked by themselves; `suits` refuses those that do not belong there.
template <class Suits>
std::vector<MechanismEntry> read_mechanisms(const Node& entry, const std::string& owner,
                                            const plugins::Catalogue& catalogue, std::vector<SharedParameter>& shared,
                                            std::vector<data::Finding>& findings, Suits suits) {
  std::vector<MechanismEntry> mechanisms;
  const auto list = entry.find("mechanisms");
  if (!list) return mechanisms;
  for (const Node& node : list->elements("a list of mechanisms, [ {\"type\": …}, … ],")) {
    node.expect_object("a mechanism, {\"type\": …},");
    const std::string type = node.require("type", fmt::format("a mechanism of {}", owner))
                                 .one_of(names_of(catalogue.mechanisms()), "mechanism");
    const MechanismFactory& factory = catalogue.mechanisms().find(type)->second.factory;
    suits(node, factory);
    const auto as = node.find("as");
    const std::string name = fmt::format("mechanism '{}'", as && as->is_text() ? as->text("") : type);
    const Block<MechanismEntry> block = mechanism_block(name, "", factory);
    block.allow_only(node);
    MechanismEntry mechanism{type, default_options(node, factory.options, name), {}};
    block.read(node, mechanism);
    if (std::any_of(mechanisms.begin(), mechanisms.end(),
                    [&](const MechanismEntry& m) { return m.name() == mechanism.name(); }))
      node.fail(fmt::format("the mechanism '{}' appears twice in {}", mechanism.name(), owner),
                "Its parameters would share their names; remove one, or name one of them with \"as\".");
    const std::vector<Parameter> parameters = parameters_of(node, factory, mechanism.options);
    mechanism.parameters = read_parameters(node, parameters, name, shared);
    for (data::Finding& finding : bare_angles(node, factory.options, parameters, name))
      findings.push_back(std::move(finding));
    mechanisms.push_back(std::move(mechanism));
  }
  return mechanisms;
}

Json list_of(const std::vector<std::string>& types) {
  return list_schema("Mechanisms to include, in any order.", by_type("mechanism", types, "One mechanism."));
}

bool applies(const MechanismFactory& mechanism, const std::string& test_type) {
  const auto& types = mechanism.applies_to;
  return types.empty() || std::find(types.begin(), types.end(), test_type) != types.end();
}

}  // namespace

std::vector<MechanismEntry> read_model_mechanisms(const Node& entry, const std::string& owner,
                                                  const plugins::Catalogue& catalogue,
                                                  std::vector<SharedParameter>& shared,
                                                  std::vector<data::Finding>& findings) {
  return read_mechanisms(
      entry, owner, catalogue, shared, findings, [](const Node& node, const MechanismFactory& mechanism) {
        if (!acts_on_model(mechanism))
          node.fail(
              fmt::format("the mechanism '{}' acts on {}, not on models", mechanism.id, stage_word(mechanism.stage)),
              "Write it in the \"mechanisms\" of a test.");
      });
}

std::vector<MechanismEntry> read_test_mechanisms(const Node& entry, const std::string& test_type,
                                                 const std::string& owner, const plugins::Catalogue& catalogue,
                                                 std::vector<SharedParameter>& shared,
                                                 std::vector<data::Finding>& findings) {
  return read_mechanisms(
      entry, owner, catalogue, shared, findings, [&](const Node& node, const MechanismFactory& mechanism) {
        if (acts_on_model(mechanism))
          node.fail(fmt::format("the mechanism '{}' acts on models, not on tests", mechanism.id),
                    "Write it in the \"mechanisms\" of a model.");
        if (!applies(mechanism, test_type))
          node.fail(fmt::format("the mechanism '{}' does not apply to tests of type '{}'", mechanism.id, test_type),
                    fmt::format("It applies to: {}.", fmt::join(mechanism.applies_to, ", ")));
      });
}

Json write_mechanisms(const std::vector<MechanismEntry>& entries, const plugins::Catalogue& catalogue) {
  Json list = Json::array();
  for (const MechanismEntry& entry : entries)
    list.push_back(mechanism_block("", "", catalogue.mechanisms().find(entry.type)->second.factory).write(entry));
  return list;
}

Json model_mechanisms_schema(const plugins::Catalogue& catalogue) {
  std::vector<std::string> types;
  for (const auto& [id, entry] : catalogue.mechanisms())
    if (acts_on_model(entry.factory)) types.push_back(id);
  return list_of(types);
}

Json test_mechanisms_schema(const std::string& test_type, const plugins::Catalogue& catalogue) {
  std::vector<std::string> types;
  for (const auto& [id, entry] : catalogue.mechanisms())
    if (!acts_on_model(entry.factory) && applies(entry.factory, test_type)) types.push_back(id);
  return list_of(types);
}

void define_mechanisms(Json& definitions, const plugins::Catalogue& catalogue) {
  for (const auto& [id, entry] : catalogue.mechanisms()) {
    const MechanismFactory& factory = entry.factory;
    Json schema = mechanism_block("", described(factory.cause, factory.reference, entry.plugin), factory).schema();
    if (!factory.native.empty()) schema["properties"].erase("as");
    definitions["mechanism_" + id] = std::move(schema);
  }
}

}  // namespace tunica::experiment
