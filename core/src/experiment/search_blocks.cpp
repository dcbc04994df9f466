// SPDX-License-Identifier: Apache-2.0
// What ends a search, what spares simulations in it, and what a failure does to it.
#include <fmt/format.h>

#include "experiment/blocks.hpp"
#include "experiment/limits.hpp"

namespace tunica::experiment {

Block<Stop> stop_block() {
  const auto above_zero = [](const Node& node, double time) {
    if (!(time > 0)) node.fail(fmt::format("the time limit is {} s", time), "It must be greater than zero.");
  };
  Key<Stop> stall = count_key("stall", "Evaluations without improvement.", &Stop::stall,
                              "a whole number of evaluations", 1, limits::evaluations);
  stall.read = [read = stall.read](const Node& node, Stop& stop) {
    read(node, stop);
    if (*stop.stall > stop.max_evaluations)
      node.fail(fmt::format("\"stall\" is {} and changes nothing: the search ends after {} evaluations", *stop.stall,
                            stop.max_evaluations),
                "Give \"max_evaluations\" above it, or leave \"stall\" out.");
  };
  return {
      "\"stop\"",
      "When a search ends; means the same for every optimizer.",
      {silent_at(count_key("max_evaluations", "Evaluations of the objective (default 60000).", &Stop::max_evaluations,
                           "a whole number of evaluations", 1, limits::evaluations),
                 no_own_limit),
       quantity_key("max_time", "Time [s], for example \"10 min\"; gives up determinism.", &Stop::max_time, "s",
                    "a time", above_zero),
       member_key(
           "target",
           [] {
             return Json{{"description", "An objective that is good enough."}, {"type", "number"}};
           },
           &Stop::target, [](const Node& node) { return node.number("the objective that is good enough, a number,"); }),
       std::move(stall)}};
}

Block<FewerSimulations> fewer_simulations_block() {
  return {"\"fewer_simulations\"",
          "What spares simulations of costly tests.",
          {flag_key("early_end",
                    "Whether an evaluation ends where cheap tests show that a search will drop the point (default "
                    "true); results stay the same.",
                    &FewerSimulations::early_end),
           flag_key("guide",
                    "Whether cheaper tests stand in while a search looks around, corrected by simulations (default "
                    "false).",
                    &FewerSimulations::guide)}};
}

Block<Experiment> on_failure_block() {
  Key<Experiment> rate =
      quantity_key("max_rate", "Share of failed evaluations above which a run stops.", &Experiment::max_failure_rate,
                   "1", "a share of failed evaluations", [](const Node& node, double share) {
                     if (!(share >= 0 && share <= 1))
                       node.fail(fmt::format("the share of failed evaluations is {}", share),
                                 "Expected a number from 0 to 1, or a percentage such as \"50 %\".");
                   });
  rate.read = [read = rate.read](const Node& node, Experiment& experiment) {
    read(node, experiment);
    if (experiment.on_failure == OnFailure::stop)
      node.fail("\"max_rate\" changes nothing beside \"policy\": \"stop\", which ends at the first failure",
                "Leave one of the two out.");
  };
  rate.write = [write = rate.write](const Experiment& experiment) {
    return experiment.on_failure == OnFailure::stop ? Json() : write(experiment);
  };
  return {"\"on_failure\"",
          "With a limit.",
          {code_key("policy", "The policy.", &Experiment::on_failure, on_failure_names, "failure policy"),
           std::move(rate)}};
}

}  // namespace tunica::experiment
