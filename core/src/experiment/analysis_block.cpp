// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "experiment/blocks.hpp"
#include "experiment/limits.hpp"

namespace tunica::experiment {
namespace {

Key<Analysis> profiles_key() {
  return {"profiles",
          [] {
            Json schema = {{"description", "Profile likelihood of these parameters, named as in results, or of all."}};
            schema["anyOf"] =
                Json::array({choice_schema("Every one.", {"all"}), list_schema("Names.", Json{{"type", "string"}})});
            return schema;
          },
          [](const Node& node, Analysis& analysis) {
            if (node.is_text()) {
              node.one_of({"all"}, "set of profiles");
              analysis.all_profiles = true;
              return;
            }
            for (const Node& entry : node.elements("\"all\" or a list of parameter names")) {
              const std::string& name = entry.text("the name of a parameter, as in results");
              analysis.profiles.push_back(name);
              analysis.profile_places.emplace(name, entry.place());
            }
          },
          [](const Analysis& analysis) {
            if (analysis.all_profiles) return Json("all");
            return analysis.profiles.empty() ? Json() : Json(analysis.profiles);
          }};
}

Block<Analysis> bootstrap_block() {
  return {"\"bootstrap\"",
          "Residual bootstrap.",
          {required(silent_at(count_key("draws", "Data sets to draw.", &Analysis::bootstrap_draws,
                                        "a whole number of draws", limits::least_draws, limits::draws),
                              0U))}};
}

Block<Analysis> posterior_block() {
  return {
      "\"posterior\"",
      "Draws from the posterior, by four chains together.",
      {required(silent_at(count_key("draws", "Draws.", &Analysis::posterior_draws, "a whole number of draws",
                                    limits::least_posterior_draws, limits::draws),
                          0U)),
       silent_at(flag_key("discrepancy", "Allow for a smooth misfit of unknown size that the model does not explain.",
                          &Analysis::discrepancy),
                 false)}};
}

/// An optimizer of the file for the refits, which are local.
Key<Analysis> optimizer_key(const Experiment& experiment) {
  Key<Analysis> key =
      name_key("optimizer", "Name of an optimizer for the refits (default: ceres_lm from the best point).",
               &Analysis::optimizer, entry_names(experiment.optimizers));
  key.read = [read = key.read, &experiment](const Node& node, Analysis& analysis) {
    read(node, analysis);
    if (!experiment.optimizer(analysis.optimizer).stages.empty())
      node.fail(fmt::format("the optimizer '{}' has stages", analysis.optimizer),
                "Refits are local: name one of its stages that searches locally.");
  };
  return silent_at(std::move(key), "");
}

Key<Analysis> map_key() {
  return {
      "map",
      [] {
        Json schema = list_schema("Two free parameters: where between their bounds is the material stable?",
                                  Json{{"type", "string"}});
        schema["minItems"] = 2;
        schema["maxItems"] = 2;
        return schema;
      },
      [](const Node& node, Analysis& analysis) {
        for (const Node& entry : node.elements("two names of parameters, as in results,")) {
          const std::string& name = entry.text("the name of a parameter, as in results");
          analysis.stability_map.push_back(name);
          analysis.map_places.emplace(name, entry.place());
        }
        if (analysis.stability_map.size() != 2) node.fail_expected("two names of parameters, as in results,");
      },
      [](const Analysis& analysis) { return analysis.stability_map.empty() ? Json() : Json(analysis.stability_map); }};
}

Key<Analysis> points_key() {
  Key<Analysis> key = count_key("points", "Points of the map along each parameter (default 41).", &Analysis::map_points,
                                "a whole number of points along each parameter", 2, limits::map_points);
  key.read = [read = key.read](const Node& node, Analysis& analysis) {
    read(node, analysis);
    if (analysis.stability_map.empty())
      node.fail("\"points\" changes nothing without \"map\"",
                "Name two parameters in \"map\", or leave \"points\" out.");
  };
  key.write = [write = key.write](const Analysis& analysis) {
    return analysis.stability_map.empty() ? Json() : write(analysis);
  };
  return key;
}

Block<Analysis> stability_block() {
  return {"\"stability\"",
          "Stability of the best points beyond what is always judged.",
          {member_key(
               "to",
               [] {
                 return Json{{"description", "Judge to this stretch instead of the largest measured one."},
                             {"type", "number"},
                             {"exclusiveMinimum", 1},
                             {"maximum", 100}};
               },
               &Analysis::stability_to,
               [](const Node& node) {
                 const double stretch = node.number("a stretch");
                 if (!(stretch > 1 && stretch <= 100))
                   node.fail(fmt::format("the stretch is {}", stretch), "Expected a stretch above 1, up to 100.");
                 return stretch;
               }),
           map_key(), points_key()}};
}

}  // namespace

Block<Analysis> analysis_block(const Experiment& experiment) {
  return {"\"analysis\"",
          "Uncertainty of every run's best point, beyond the intervals that are always given.",
          {profiles_key(), block_key("bootstrap", bootstrap_block().expecting("an object, {\"draws\": 200},")),
           block_key("posterior", posterior_block().expecting("an object, {\"draws\": 4000},")),
           optimizer_key(experiment), block_key("stability", stability_block())}};
}

}  // namespace tunica::experiment
