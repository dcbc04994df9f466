// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "experiment/blocks.hpp"
#include "experiment/suggest.hpp"
#include "plugins/guarded.hpp"

namespace tunica::experiment {
namespace {

using Stage = OptimizerEntry::Stage;

Block<Stage> stage_block(const std::vector<std::string>& names) {
  return {"a stage",
          "A stage with its own stop.",
          {required(member_key(
               "optimizer", [] { return text_schema("Name of another optimizer."); }, &Stage::optimizer,
               [=](const Node& node) { return node.one_of(names, "optimizer"); })),
           {"stop", [] { return reference("stop"); },
            [](const Node& node, Stage& stage) {
              stage.stop.emplace().max_evaluations = no_own_limit;
              stop_block().read(node, *stage.stop);
            },
            [](const Stage& stage) { return stage.stop ? stop_block().write(*stage.stop) : Json(); }}}};
}

Key<OptimizerEntry> stages_key(const std::string& name, const std::vector<std::string>& names) {
  const auto schema = [] {
    Json stages = list_schema("Optimizers one after the other, each from the best point so far.", Json::object());
    stages["items"]["anyOf"] = Json::array({Json{{"type", "string"}}, stage_block({}).schema()});
    stages["minItems"] = 1;
    return stages;
  };
  const auto read = [=](const Node& stages, OptimizerEntry& optimizer) {
    for (const Node& node : stages.elements("a list of optimizer names")) {
      Stage stage;
      if (node.is_object())
        stage_block(names).read(node, stage);
      else
        stage.optimizer = node.one_of(names, "optimizer");
      if (stage.optimizer == name)
        node.fail(fmt::format("the optimizer '{}' names itself as a stage", name),
                  "A stage is another entry of \"optimizers\".");
      optimizer.stages.push_back(std::move(stage));
    }
    if (optimizer.stages.empty())
      stages.fail(fmt::format("the optimizer '{}' has no stages", name), "Name at least one optimizer.");
  };
  const auto write = [](const OptimizerEntry& optimizer) {
    Json stages = Json::array();
    for (const Stage& stage : optimizer.stages) stages.push_back(stage_block({}).write(stage));
    return stages;
  };
  return required<OptimizerEntry>({"stages", schema, read, write});
}

Block<OptimizerEntry> stages_block(const std::string& name, const std::vector<std::string>& names) {
  Key<OptimizerEntry> type{
      "type",
      [] {
        return Json{{"const", "stages"}};
      },
      [](const Node& node, OptimizerEntry&) { node.one_of({"stages"}, "type of a staged optimizer"); }};
  return {fmt::format("the staged optimizer '{}'", name),
          "Several optimizers in turn.",
          {std::move(type), stages_key(name, names)}};
}

Block<OptimizerEntry> optimizer_block(const std::string& owner, const std::string& doc,
                                      const OptimizerFactory& factory) {
  return {owner, doc, keys_of_plugin<OptimizerEntry>(factory.type, factory.options)};
}

OptimizerEntry read_optimizer(const std::string& name, const Node& entry, const plugins::Catalogue& catalogue) {
  const std::string owner = fmt::format("optimizer '{}'", name);
  OptimizerEntry optimizer;
  optimizer.name = name;
  optimizer.type = entry.require("type", owner).one_of(names_of(catalogue.optimizers()), "optimizer type");
  const auto& available = catalogue.optimizers().find(optimizer.type)->second;
  const Block<OptimizerEntry> block = optimizer_block(owner, "", available.factory);
  block.allow_only(entry);
  optimizer.options = default_options(entry, available.factory.options, owner);
  block.read(entry, optimizer);
  try {
    static_cast<void>(
        plugins::create(available, optimizer.options));  // the plugin may know more than its declaration says
  } catch (const InputError& error) {
    entry.fail(fmt::format("{} is refused", owner), error.what());
  }
  return optimizer;
}

/// One level only: a stage that is itself staged would make "shared budget" ambiguous.
void refuse_nested_stages(const Node& node, const std::vector<OptimizerEntry>& optimizers) {
  for (const OptimizerEntry& optimizer : optimizers)
    for (std::size_t i = 0; i < optimizer.stages.size(); ++i) {
      const auto& stage = optimizer.stages[i].optimizer;
      const auto other =
          std::find_if(optimizers.begin(), optimizers.end(), [&](const OptimizerEntry& o) { return o.name == stage; });
      if (!other->stages.empty())
        node.require(optimizer.name, "")
            .require("stages", "")
            .element(i)
            .fail(fmt::format("the stage '{}' of '{}' has stages itself", stage, optimizer.name),
                  "Name the optimizers one by one.");
    }
}

}  // namespace

std::vector<OptimizerEntry> read_optimizers(const Node& node, const plugins::Catalogue& catalogue) {
  const auto entries = node.members("an object with one entry per optimizer");
  if (entries.empty())
    node.fail("no optimizer is given", "Give at least one, for example \"lm\": {\"type\": \"ceres_lm\"}.");
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries) names.push_back(name);
  std::vector<OptimizerEntry> optimizers;
  for (const auto& [name, entry] : entries) {
    entry.expect_object("an optimizer, {\"type\": …} or {\"stages\": […]},");
    entry.check_name(name, "optimizer");
    if (entry.find("stages")) {
      OptimizerEntry staged{name, "stages", {}, {}};
      stages_block(name, names).read(entry, staged);
      optimizers.push_back(std::move(staged));
    } else {
      optimizers.push_back(read_optimizer(name, entry, catalogue));
    }
  }
  refuse_nested_stages(node, optimizers);
  return optimizers;
}

Json write_optimizer(const OptimizerEntry& entry, const plugins::Catalogue& catalogue) {
  if (!entry.stages.empty()) return stages_block("", {}).write(entry);
  return optimizer_block("", "", catalogue.optimizers().find(entry.type)->second.factory).write(entry);
}

void define_optimizers(Json& definitions, const plugins::Catalogue& catalogue) {
  definitions["staged"] = stages_block("", {}).schema();
  Json either = {{"description", "An optimizer of a type, or stages."}, {"type", "object"}};
  either["if"]["required"] = {"stages"};
  either["then"] = reference("staged");
  either["else"] = by_type("optimizer", names_of(catalogue.optimizers()), "An optimizer.");
  definitions["optimizer"] = std::move(either);
  for (const auto& [type, entry] : catalogue.optimizers())
    definitions["optimizer_" + type] =
        optimizer_block("", described(entry.factory.doc, entry.factory.reference, entry.plugin), entry.factory)
            .schema();
}

}  // namespace tunica::experiment
