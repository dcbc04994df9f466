// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "experiment/limits.hpp"
#include "experiment/reader.hpp"
#include "experiment/suggest.hpp"
#include "plugins/guarded.hpp"

namespace tunica::experiment {
namespace {

OptimizerEntry read_stages(const std::string& name, const Node& entry, const std::vector<std::string>& names) {
  OptimizerEntry optimizer;
  optimizer.name = name;
  optimizer.type = "stages";
  entry.allow_only({"type", "stages"}, fmt::format("the staged optimizer '{}'", name));
  if (const auto type = entry.find("type")) type->one_of({"stages"}, "type of a staged optimizer");
  const Node stages = entry.require("stages", fmt::format("the staged optimizer '{}'", name));
  for (const Node& node : stages.elements("a list of optimizer names")) {
    OptimizerEntry::Stage stage;
    if (node.is_object()) {
      node.allow_only({"optimizer", "stop"}, "a stage");
      stage.optimizer = node.require("optimizer", "a stage").one_of(names, "optimizer");
      if (const auto stop = node.find("stop")) stage.stop = read_stop(*stop, no_own_limit);
    } else {
      stage.optimizer = node.one_of(names, "optimizer");
    }
    if (stage.optimizer == name)
      node.fail(fmt::format("the optimizer '{}' names itself as a stage", name),
                "A stage is another entry of \"optimizers\".");
    optimizer.stages.push_back(std::move(stage));
  }
  if (optimizer.stages.empty())
    stages.fail(fmt::format("the optimizer '{}' has no stages", name), "Name at least one optimizer.");
  return optimizer;
}

}  // namespace

Stop read_stop(const Node& node, std::uint64_t default_evaluations) {
  node.allow_only({"max_evaluations", "max_time", "target", "stall"}, "\"stop\"");
  Stop stop;
  stop.max_evaluations = default_evaluations;
  if (const auto child = node.find("max_evaluations"))
    stop.max_evaluations = child->count("a whole number of evaluations", 1, limits::evaluations);
  if (const auto child = node.find("max_time")) {
    stop.max_time = child->quantity("s", "a time");
    if (!(*stop.max_time > 0))
      child->fail(fmt::format("the time limit is {} s", *stop.max_time), "It must be greater than zero.");
  }
  if (const auto child = node.find("target"))
    stop.target = child->number("the objective that is good enough, a number,");
  if (const auto child = node.find("stall")) {
    stop.stall = child->count("a whole number of evaluations", 1, limits::evaluations);
    if (*stop.stall > stop.max_evaluations)
      child->fail(fmt::format("\"stall\" is {} and changes nothing: the search ends after {} evaluations", *stop.stall,
                              stop.max_evaluations),
                  "Give \"max_evaluations\" above it, or leave \"stall\" out.");
  }
  return stop;
}

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
      optimizers.push_back(read_stages(name, entry, names));
      continue;
    }
    const std::string owner = fmt::format("optimizer '{}'", name);
    OptimizerEntry optimizer;
    optimizer.name = name;
    optimizer.type = entry.require("type", owner).one_of(names_of(catalogue.optimizers()), "optimizer type");
    const auto& available = catalogue.optimizers().find(optimizer.type)->second;
    optimizer.options = read_options(entry, available.factory.options, {"type"}, owner);
    try {
      static_cast<void>(
          plugins::create(available, optimizer.options));  // the plugin may know more than its declaration says
    } catch (const InputError& error) {
      entry.fail(fmt::format("{} is refused", owner), error.what());
    }
    optimizers.push_back(std::move(optimizer));
  }
  // One level only: a stage that is itself staged would make "shared budget" ambiguous.
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
  return optimizers;
}

void read_analysis(const Node& node, Experiment& experiment) {
  node.allow_only({"profiles", "bootstrap", "posterior", "optimizer", "stability"}, "\"analysis\"");
  Analysis& analysis = experiment.analysis;
  if (const auto profiles = node.find("profiles")) {
    if (profiles->is_text()) {
      profiles->one_of({"all"}, "set of profiles");
      analysis.all_profiles = true;
    } else {
      for (const Node& entry : profiles->elements("\"all\" or a list of parameter names")) {
        const std::string& name = entry.text("the name of a parameter, as in results");
        analysis.profiles.push_back(name);
        analysis.profile_places.emplace(name, entry.place());
      }
    }
  }
  if (const auto bootstrap = node.find("bootstrap")) {
    bootstrap->expect_object("an object, {\"draws\": 200},");
    bootstrap->allow_only({"draws"}, "\"bootstrap\"");
    analysis.bootstrap_draws = bootstrap->require("draws", "\"bootstrap\"")
                                   .count("a whole number of draws", limits::least_draws, limits::draws);
  }
  if (const auto posterior = node.find("posterior")) {
    posterior->expect_object("an object, {\"draws\": 4000},");
    posterior->allow_only({"draws", "discrepancy"}, "\"posterior\"");
    analysis.posterior_draws = posterior->require("draws", "\"posterior\"")
                                   .count("a whole number of draws", limits::least_posterior_draws, limits::draws);
    if (const auto discrepancy = posterior->find("discrepancy"))
      analysis.discrepancy = discrepancy->flag("true or false");
  }
  if (const auto optimizer = node.find("optimizer")) {
    analysis.optimizer = optimizer->one_of(entry_names(experiment.optimizers), "optimizer");
    if (!experiment.optimizer(analysis.optimizer).stages.empty())
      optimizer->fail(fmt::format("the optimizer '{}' has stages", analysis.optimizer),
                      "Refits are local: name one of its stages that searches locally.");
  }
  if (const auto stability = node.find("stability")) {
    stability->allow_only({"to", "map", "points"}, "\"stability\"");
    if (const auto to = stability->find("to")) {
      analysis.stability_to = to->number("a stretch");
      if (!(*analysis.stability_to > 1 && *analysis.stability_to <= 100))
        to->fail(fmt::format("the stretch is {}", *analysis.stability_to), "Expected a stretch above 1, up to 100.");
    }
    if (const auto map = stability->find("map")) {
      for (const Node& entry : map->elements("two names of parameters, as in results,")) {
        const std::string& name = entry.text("the name of a parameter, as in results");
        analysis.stability_map.push_back(name);
        analysis.map_places.emplace(name, entry.place());
      }
      if (analysis.stability_map.size() != 2) map->fail_expected("two names of parameters, as in results,");
    }
    if (const auto points = stability->find("points")) {
      analysis.map_points = points->count("a whole number of points along each parameter", 2, limits::map_points);
      if (analysis.stability_map.empty())
        points->fail("\"points\" changes nothing without \"map\"",
                     "Name two parameters in \"map\", or leave \"points\" out.");
    }
  }
}

}  // namespace tunica::experiment
