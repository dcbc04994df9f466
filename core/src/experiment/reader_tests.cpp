// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "data/quantities.hpp"
#include "experiment/reader.hpp"

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

HoldOut read_hold_out(const Node& node) {
  HoldOut hold_out;
  if (node.is_flag())
    hold_out.all = node.flag("");
  else if (node.is_text())
    hold_out.rows = read_row_range(node);
  else
    node.fail_expected("true, false or a row range such as \"200:240\"");
  return hold_out;
}

std::vector<LayerEntry> read_layers(const Node& entry, const std::string& type, const std::vector<std::string>& models,
                                    const plugins::Catalogue& catalogue) {
  const auto list = entry.find("layers");
  if (!list) return {};
  if (!catalogue.tests().find(type)->second.factory.layered) {
    std::vector<std::string> types;
    for (const auto& [name, test] : catalogue.tests())
      if (test.factory.layered) types.push_back(name);
    list->fail(
        fmt::format("a test of type '{}' has one model throughout and takes no layers", type),
        types.empty() ? "Remove \"layers\"." : fmt::format("Tests that take layers: {}.", fmt::join(types, ", ")));
  }
  std::vector<LayerEntry> layers;
  for (const Node& node : list->elements("a list of layers from inside, [ {\"model\": …, \"thickness\": …}, … ],")) {
    node.expect_object("a layer, {\"model\": …, \"thickness\": …},");
    node.allow_only({"model", "thickness"}, "a layer");
    LayerEntry layer{node.require("model", "a layer").one_of(models, "model"), 0};
    const Node thickness = node.require("thickness", "a layer");
    layer.thickness = thickness.quantity("mm", "the thickness of a layer");
    if (!(layer.thickness > 0))
      thickness.fail(fmt::format("the thickness of the layer is {} mm", layer.thickness),
                     "It must be greater than zero.");
    layers.push_back(std::move(layer));
  }
  if (layers.empty())
    list->fail("the list of layers is empty", "Leave \"layers\" out where the model of the run serves the test.");
  return layers;
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
  std::vector<std::string> keys = {"type", "data", "weight", "hold_out", "parameters", "mechanisms"};
  const bool has_state = factory.options.end() == std::find_if(factory.options.begin(), factory.options.end(),
                                                               [](const Option& o) { return o.name == "state"; });
  if (has_state) keys.emplace_back("state");
  if (factory.layered) keys.emplace_back("layers");
  test.options = read_options(entry, factory.options, keys, owner);
  test.folder = std::filesystem::absolute(folder.empty() ? "." : folder);
  if (test.options.has("folder")) {  // absolute from here on, so that a copy of the file elsewhere means the same
    test.folder = (test.folder / test.options.text("folder")).lexically_normal();
    test.options.set("folder", test.folder.string());
  }
  test.findings = bare_angles(entry, factory.options, factory.parameters, owner);
  test.parameters = read_mentioned_parameters(entry, factory.parameters, owner, shared);
  test.mechanisms = read_test_mechanisms(entry, type, owner, catalogue, shared, test.findings);
  if (const auto node = has_state ? entry.find("state") : std::nullopt) {
    if (named.states.empty())
      node->fail(fmt::format("{} names a state, and the experiment has no \"states\"", owner),
                 "Add them, for example \"states\": {\"relaxed\": {\"parameters\": {\"mu\": {}}}}.");
    test.state = node->one_of(named.states, "state");
  }
  test.data = read_data(entry.require("data", owner), factory.observables, owner, folder);
  for (data::Finding& finding : odd_sizes(entry, test, factory.options, owner))
    test.findings.push_back(std::move(finding));
  const auto channels = std::count_if(test.data.columns.begin(), test.data.columns.end(), [&](const auto& column) {
    return data::quantity_named(column.first, factory.observables)->observable->role == Role::channel;
  });
  test.measured = channels > 0;
  test.weights = read_weights(entry, static_cast<std::size_t>(channels), owner);
  if (const auto node = entry.find("hold_out")) test.hold_out = read_hold_out(*node);
  // Weights of 1 stand in every saved input, and say nothing.
  if (test.hold_out.all && std::any_of(test.weights.begin(), test.weights.end(), [](double one) { return one != 1; }))
    entry.require("weight", owner)
        .fail(fmt::format("\"weight\" changes nothing in {}, which is held out", owner),
              "Leave one of \"weight\" and \"hold_out\" out.");
  return test;
}

}  // namespace tunica::experiment
