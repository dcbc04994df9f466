// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/blocks.hpp"
#include "experiment/limits.hpp"

namespace tunica::experiment {
namespace {

Block<LayerEntry> layer_block(const std::vector<std::string>& models) {
  const auto above_zero = [](const Node& node, double thickness) {
    if (!(thickness > 0))
      node.fail(fmt::format("the thickness of the layer is {} mm", thickness), "It must be greater than zero.");
  };
  const auto model_schema = [] {
    Json schema = text_schema("Name of a model.");
    schema["minLength"] = 1;
    return schema;
  };
  return Block<LayerEntry>(
             "a layer", "A layer with a model of its own.",
             {required(member_key("model", model_schema, &LayerEntry::model,
                                  [=](const Node& node) { return node.one_of(models, "model"); })),
              required(quantity_key("thickness", "Its thickness in the unloaded wall [mm].", &LayerEntry::thickness,
                                    "mm", "the thickness of a layer", above_zero))})
      .expecting("a layer, {\"model\": …, \"thickness\": …},");
}

/// Throws where the type of test has one model throughout.
void refuse_unlayered(const Node& list, const std::string& type, const plugins::Catalogue& catalogue) {
  if (catalogue.tests().find(type)->second.factory.layered) return;
  std::vector<std::string> types;
  for (const auto& [name, test] : catalogue.tests())
    if (test.factory.layered) types.push_back(name);
  list.fail(fmt::format("a test of type '{}' has one model throughout and takes no layers", type),
            types.empty() ? "Remove \"layers\"." : fmt::format("Tests that take layers: {}.", fmt::join(types, ", ")));
}

}  // namespace

std::vector<LayerEntry> read_layers(const Node& entry, const std::string& type, const std::vector<std::string>& models,
                                    const plugins::Catalogue& catalogue) {
  const auto list = entry.find("layers");
  if (!list) return {};
  refuse_unlayered(*list, type, catalogue);
  std::vector<LayerEntry> layers;
  for (const Node& node : list->elements("a list of layers from inside, [ {\"model\": …, \"thickness\": …}, … ],"))
    layer_block(models).read(node, layers.emplace_back());
  if (layers.empty())
    list->fail("the list of layers is empty", "Leave \"layers\" out where the model of the run serves the test.");
  return layers;
}

Key<TestEntry> layers_key() {
  const auto schema = [] {
    Json layers = list_schema("Layers of the wall from inside; without them the model of the run fills it.",
                              layer_block({}).schema());
    layers["minItems"] = 1;
    return layers;
  };
  const auto write = [](const TestEntry& test) {
    Json json;
    for (const LayerEntry& layer : test.layers) json.push_back(layer_block({}).write(layer));
    return json;
  };
  return {"layers", schema, {}, write};
}

}  // namespace tunica::experiment
