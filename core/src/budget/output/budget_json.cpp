// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "budget/output/outputs.hpp"
#include "comparison/result_json.hpp"
#include "diagnosis/output/fitted_experiment.hpp"
#include "diagnosis/output/outputs.hpp"
#include "experiment/reader.hpp"
#include "results/keys.hpp"

namespace tunica::budget {

namespace key = results::key;
namespace {

using json = nlohmann::ordered_json;

const char* belief_code(Belief belief) {
  return belief == Belief::plausible ? "plausible" : belief == Belief::flagged ? "flagged" : "beyond";
}

}  // namespace

json budget_json(const Budget& budget) {
  json steps = json::array(), contenders = json::array();
  for (const Step& step : budget.steps)
    steps.push_back({{key::id, step.id},
                     {key::term, step.term},
                     {key::target, diagnosis::place_json(step.place)},
                     {key::group, diagnosis::code_of(step.group)},
                     {key::belief, belief_code(step.belief)},
                     {key::share, step.share},
                     {key::shapley, step.shapley},
                     {key::rms, step.rest.rms},
                     {key::rms_upper, step.rest.upper}});
  for (const Contender& one : budget.contenders)
    contenders.push_back({{key::id, one.id},
                          {key::acts_like, one.sort},
                          {key::term, one.term},
                          {key::target, diagnosis::place_json(one.place)},
                          {key::group, diagnosis::code_of(one.group)},
                          {key::belief, belief_code(one.belief)},
                          {key::share, one.share},
                          {key::probability, one.probability},
                          {key::rms, one.rest.rms}});
  json result = {{key::tolerance, budget.tolerance.share},
                 {key::tolerance_origin, diagnosis::code_of(budget.tolerance.origin)},
                 {key::rms, budget.base.rms},
                 {key::rms_upper, budget.base.upper},
                 {key::steps, std::move(steps)},
                 {key::adequate, budget.adequate},
                 {key::channels, comparison::channel_sizes_json(budget.base_channels)},
                 {key::rest, comparison::channel_sizes_json(budget.rest_channels)}};
  if (!budget.same_model.empty())
    result[key::same_model] = {{key::type, budget.same_model}, {key::with, budget.same_with}};
  json untried = json::array();
  for (const Budget::Untried& one : budget.not_looked_for) untried.push_back(one.id);
  if (!untried.empty()) result[key::not_looked_for] = std::move(untried);
  if (budget.contenders.empty()) return result;
  if (budget.lead)
    result[key::lead] = {{key::id, budget.lead->id},
                         {key::acts_like, budget.lead->sort},
                         {key::target, diagnosis::place_json(budget.lead->place)},
                         {key::group, diagnosis::code_of(budget.lead->group)}};
  if (budget.state) {
    json changes = json::array();
    for (const ProposedState::Change& one : budget.state->changes)
      changes.push_back({{key::parameter, one.parameter},
                         {key::unit, one.unit},
                         {key::value, one.value},
                         {key::in_state, one.in_state}});
    result[key::state] = {{key::name, budget.state->name},
                          {key::test, budget.state->test},
                          {key::share, budget.state->share},
                          {key::changes, std::move(changes)}};
  }
  result[key::alone] = std::move(contenders);
  result[key::unlisted_probability] = budget.unlisted_probability;
  result[key::rough] = budget.rough;
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
