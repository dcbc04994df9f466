// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "budget/output/outputs.hpp"
#include "comparison/result_json.hpp"
#include "diagnosis/output/fitted_experiment.hpp"
#include "diagnosis/output/outputs.hpp"
#include "experiment/reader.hpp"

namespace tunica::budget {
namespace {

using json = nlohmann::ordered_json;

const char* belief_code(Belief belief) {
  return belief == Belief::plausible ? "plausible" : belief == Belief::flagged ? "flagged" : "beyond";
}

}  // namespace

json budget_json(const Budget& budget) {
  json steps = json::array(), contenders = json::array();
  for (const Step& step : budget.steps)
    steps.push_back({{"id", step.id},
                     {"term", step.term},
                     {"target", diagnosis::place_json(step.place)},
                     {"group", diagnosis::code_of(step.group)},
                     {"belief", belief_code(step.belief)},
                     {"share", step.share},
                     {"shapley", step.shapley},
                     {"rms", step.rest.rms},
                     {"rms_upper", step.rest.upper}});
  for (const Contender& one : budget.contenders)
    contenders.push_back({{"id", one.id},
                          {"acts_like", one.sort},
                          {"term", one.term},
                          {"target", diagnosis::place_json(one.place)},
                          {"group", diagnosis::code_of(one.group)},
                          {"belief", belief_code(one.belief)},
                          {"share", one.share},
                          {"probability", one.probability},
                          {"rms", one.rest.rms}});
  json result = {{"tolerance", budget.tolerance.share},
                 {"tolerance_origin", diagnosis::code_of(budget.tolerance.origin)},
                 {"rms", budget.base.rms},
                 {"rms_upper", budget.base.upper},
                 {"steps", std::move(steps)},
                 {"adequate", budget.adequate},
                 {"channels", comparison::channel_sizes_json(budget.base_channels)},
                 {"rest", comparison::channel_sizes_json(budget.rest_channels)}};
  if (!budget.same_model.empty()) result["same_model"] = {{"type", budget.same_model}, {"with", budget.same_with}};
  json untried = json::array();
  for (const Budget::Untried& one : budget.not_looked_for) untried.push_back(one.id);
  if (!untried.empty()) result["not_looked_for"] = std::move(untried);
  if (budget.contenders.empty()) return result;
  if (budget.lead)
    result["lead"] = {{"id", budget.lead->id},
                      {"acts_like", budget.lead->sort},
                      {"target", diagnosis::place_json(budget.lead->place)},
                      {"group", diagnosis::code_of(budget.lead->group)}};
  if (budget.state) {
    json changes = json::array();
    for (const ProposedState::Change& one : budget.state->changes)
      changes.push_back(
          {{"parameter", one.parameter}, {"unit", one.unit}, {"value", one.value}, {"in_state", one.in_state}});
    result["state"] = {{"name", budget.state->name},
                       {"test", budget.state->test},
                       {"share", budget.state->share},
                       {"changes", std::move(changes)}};
  }
  result["alone"] = std::move(contenders);
  result["unlisted_probability"] = budget.unlisted_probability;
  result["rough"] = budget.rough;
  return result;
}

std::string extended_experiment(const Budget& budget, const diagnosis::Diagnosis& d,
                                const plugins::Catalogue& catalogue) {
  if (budget.state)
    return experiment::write_input(
        diagnosis::fitted_experiment(budget.state->experiment, d.analysis.evidence.run, *budget.state->assembly,
                                     budget.state->fit.free, d.request.optimizer, catalogue),
        catalogue);
  if (!budget.fitted) return {};
  experiment::Experiment experiment = budget.fitted->extension->experiment();
  return experiment::write_input(
      diagnosis::fitted_experiment(std::move(experiment), d.analysis.evidence.run, budget.fitted->extension->assembly(),
                                   budget.fitted->fit.free, d.request.optimizer, catalogue),
      catalogue);
}

}  // namespace tunica::budget
