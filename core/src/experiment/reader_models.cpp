// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/materials.hpp"
#include "experiment/reader.hpp"
#include "experiment/suggest.hpp"
#include "plugins/guarded.hpp"

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

/// The mechanisms of one list, checked by themselves; `suits` refuses those that do not belong there.
template <class Suits>
std::vector<MechanismEntry> read_mechanisms(const Node& entry, const std::string& owner,
                                            const plugins::Catalogue& catalogue, std::vector<SharedParameter>& shared,
                                            std::vector<data::Finding>& findings, Suits suits) {
  std::vector<MechanismEntry> mechanisms;
  const auto list = entry.find("mechanisms");
  if (!list) return mechanisms;
  for (const Node& node : list->elements("a list of mechanisms, [ {\"type\": …}, … ],")) {
    const std::string of = fmt::format("a mechanism of {}", owner);
    node.expect_object("a mechanism, {\"type\": …},");
    const std::string type = node.require("type", of).one_of(names_of(catalogue.mechanisms()), "mechanism");
    const MechanismFactory& factory = catalogue.mechanisms().find(type)->second.factory;
    suits(node, factory);
    MechanismEntry mechanism{type, {}, {}};
    if (const auto as = node.find("as")) {
      mechanism.as = as->text("a name for the parameters of this mechanism");
      as->check_name(mechanism.as, "mechanism");
      if (!factory.native.empty())
        as->fail(fmt::format("the mechanism '{}' is a parameter that a test has once", type), "Take \"as\" out.");
    }
    if (std::any_of(mechanisms.begin(), mechanisms.end(),
                    [&](const MechanismEntry& m) { return m.name() == mechanism.name(); }))
      node.fail(fmt::format("the mechanism '{}' appears twice in {}", mechanism.name(), owner),
                "Its parameters would share their names; remove one, or name one of them with \"as\".");
    const std::string name = fmt::format("mechanism '{}'", mechanism.name());
    mechanism.options = read_options(node, factory.options, {"type", "as", "parameters"}, name);
    const std::vector<Parameter> parameters = parameters_of(node, factory, mechanism.options);
    mechanism.parameters = read_parameters(node, parameters, name, shared);
    for (data::Finding& finding : bare_angles(node, factory.options, parameters, name))
      findings.push_back(std::move(finding));
    mechanisms.push_back(std::move(mechanism));
  }
  return mechanisms;
}

/// Wraps the model in its mechanisms as a run will, in canonical order, so that a mechanism that cannot apply (for want
/// of fibres, say) is refused here, with its place.
void try_mechanisms(const Node& entry, std::unique_ptr<Model> model, const std::vector<MechanismEntry>& mechanisms,
                    const plugins::Catalogue& catalogue) {
  std::vector<std::size_t> order(mechanisms.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto stage = [&](std::size_t i) {
    return catalogue.mechanisms().find(mechanisms[i].type)->second.factory.stage;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return stage(a) < stage(b); });
  for (const std::size_t i : order) {
    try {
      model = plugins::wrap(catalogue.mechanisms().find(mechanisms[i].type)->second, std::move(model),
                            mechanisms[i].options);
    } catch (const InputError& error) {
      entry.require("mechanisms", "")
          .element(i)
          .fail(fmt::format("the mechanism '{}' cannot act on this model", mechanisms[i].type), error.what());
    }
  }
}

}  // namespace

ModelEntry read_model(const std::string& name, const Node& entry, const plugins::Catalogue& catalogue,
                      std::vector<SharedParameter>& shared) {
  entry.expect_object("a model, {\"type\": …},");
  entry.check_name(name, "model");
  const std::string owner = fmt::format("model '{}'", name);
  const std::string type = entry.require("type", owner).one_of(names_of(catalogue.models()), "model type");
  const auto& available = catalogue.models().find(type)->second;
  const auto& declared = available.factory.options;
  const Options options = read_options(entry, declared, {"type", "parameters", "mechanisms", material_key}, owner);
  ModelEntry model{name, type, options, {}, {}};
  const bool own_option =
      std::any_of(declared.begin(), declared.end(), [](const Option& option) { return option.name == material_key; });
  if (const auto node = entry.find(material_key); node && !own_option)
    model.options.set(material_key, node->one_of(known_materials(), "material"));
  std::unique_ptr<Model> instance;
  try {
    instance = plugins::create(available, options);
  } catch (const InputError& error) {
    entry.fail(fmt::format("{} is refused", owner), error.what());
  }
  model.findings = bare_angles(entry, available.factory.options, instance->describe().parameters, owner);
  model.parameters = read_parameters(entry, instance->describe().parameters, owner, shared);
  model.mechanisms = read_mechanisms(
      entry, owner, catalogue, shared, model.findings, [&](const Node& node, const MechanismFactory& mechanism) {
        if (!acts_on_model(mechanism))
          node.fail(
              fmt::format("the mechanism '{}' acts on {}, not on models", mechanism.id, stage_word(mechanism.stage)),
              "Write it in the \"mechanisms\" of a test.");
      });
  try_mechanisms(entry, std::move(instance), model.mechanisms, catalogue);
  return model;
}

std::vector<MechanismEntry> read_test_mechanisms(const Node& entry, const std::string& test_type,
                                                 std::string_view owner, const plugins::Catalogue& catalogue,
                                                 std::vector<SharedParameter>& shared,
                                                 std::vector<data::Finding>& findings) {
  return read_mechanisms(
      entry, std::string(owner), catalogue, shared, findings, [&](const Node& node, const MechanismFactory& mechanism) {
        if (acts_on_model(mechanism))
          node.fail(fmt::format("the mechanism '{}' acts on models, not on tests", mechanism.id),
                    "Write it in the \"mechanisms\" of a model.");
        const auto& types = mechanism.applies_to;
        if (!types.empty() && std::find(types.begin(), types.end(), test_type) == types.end())
          node.fail(fmt::format("the mechanism '{}' does not apply to tests of type '{}'", mechanism.id, test_type),
                    fmt::format("It applies to: {}.", fmt::join(types, ", ")));
      });
}

}  // namespace tunica::experiment
