// SPDX-License-Identifier: Apache-2.0
#include "execution/plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "assembly/guide.hpp"
#include "assembly/memory.hpp"
#include "plugins/guarded.hpp"
#include "tunica/error.hpp"
#include "tunica/random.hpp"

namespace tunica::execution {

namespace {

PlannedStage plan_stage(const experiment::OptimizerEntry& entry, const experiment::Stop* own_stop,
                        const plugins::Catalogue& catalogue) {
  const auto found = catalogue.optimizers().find(entry.type);
  if (found == catalogue.optimizers().end())
    throw InputError(fmt::format("optimizers.{}: no plugin provides the type '{}'; see `tunica list optimizers`",
                                 entry.name, entry.type));
  return {&entry, &found->second, own_stop};
}

std::vector<PlannedStage> plan_stages(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                                      const plugins::Catalogue& catalogue) {
  const auto& optimizer = experiment.optimizer(run.optimizer);
  if (optimizer.stages.empty()) return {plan_stage(optimizer, nullptr, catalogue)};
  std::vector<PlannedStage> stages;
  for (const auto& stage : optimizer.stages) {
    const auto& entry = experiment.optimizer(stage.optimizer);
    if (!entry.stages.empty())
      throw InputError(fmt::format("optimizers.{}: the stage '{}' has stages itself; list its stages here instead",
                                   optimizer.name, entry.name));
    stages.push_back(plan_stage(entry, stage.stop ? &*stage.stop : nullptr, catalogue));
  }
  return stages;
}

/// Constraints need an optimiser that handles them. A gradient-based one also needs their derivatives, at least at the
/// start.
void check_constraints(const PlannedRun& run, const PlannedStage& stage, const Optimizer::Needs& needs) {
  const std::size_t count = run.assembly->constraints().count();
  if (count == 0) return;
  if (!needs.constraints)
    throw InputError(
        fmt::format("run {}: the optimiser '{}' ({}) does not meet constraints, and there are some; choose one that "
                    "does (docs/optimizers.md), or set \"constraints\": [] in the run",
                    run.label, stage.entry->name, stage.entry->type));
  if (!needs.gradient) return;
  const std::vector<double> x = run.assembly->box().initial();
  std::vector<double> free(x.size()), values(count), jacobian(count * x.size());
  run.assembly->box().from_unit(x, free);
  // If the values are missing too, the initial parameters are at fault, and other starts may still work.
  if (run.assembly->constraints().evaluate(free, values, {}).kind() == Status::Kind::failed) return;
  const Status status = run.assembly->constraints().evaluate(free, values, jacobian);
  const bool finite = std::all_of(jacobian.begin(), jacobian.end(), [](double entry) { return std::isfinite(entry); });
  if (status.kind() == Status::Kind::failed || !finite)
    throw InputError(fmt::format(
        "run {}: the optimiser '{}' ({}) needs derivatives of the constraints, which this model does not give{}{}; "
        "choose one that needs none, such as es",
        run.label, stage.entry->name, stage.entry->type, status.reason().empty() ? "" : ": ", status.reason()));
}

/// Whether there are measured values. Without any, `tunica check` still describes the rows, and no search runs.
bool is_measured(const assembly::Layout& layout) {
  return std::any_of(layout.channels.begin(), layout.channels.end(), [](const auto& channel) {
    return std::any_of(channel.measured.begin(), channel.measured.end(),
                       [](double value) { return !std::isnan(value); });
  });
}

/// Whether a row counts in the objective.
bool is_weighed(const assembly::Layout& layout) {
  return std::any_of(layout.channels.begin(), layout.channels.end(), [](const auto& channel) {
    return channel.weight > 0 && std::find(channel.fitted.begin(), channel.fitted.end(), true) != channel.fitted.end();
  });
}

/// Refuses unworkable settings before the first evaluation, and warns of wasteful ones.
void check_needs(const PlannedRun& run, std::vector<Warning>& warnings) {
  if (run.assembly->layout().parameters.empty())
    throw InputError(
        fmt::format("run {}: every parameter is fixed, there is nothing to fit; free one, or use "
                    "`tunica simulate` to see the predictions",
                    run.label));
  bool random = false;
  for (const auto& stage : run.stages) {
    const auto optimizer = plugins::create(*stage.optimizer, stage.entry->options);
    const auto needs = plugins::needs(stage.optimizer->plugin, *optimizer);
    random = random || needs.random;
    if (needs.residuals && run.assembly->layout().blocks.empty() && is_measured(run.assembly->layout()))
      throw InputError(
          fmt::format("run {}: the optimiser '{}' ({}) works on residuals, and the objective has none: every "
                      "row is held out. Set hold_out to false in a test, or take out the run",
                      run.label, stage.entry->name, stage.entry->type));
    if (run.assembly->layout().parameters.size() > needs.most_parameters)
      throw InputError(
          fmt::format("run {}: the optimiser '{}' ({}) can search {} parameters at most with the population it is "
                      "given, and {} are free; enlarge it, or leave it out for a default that fits",
                      run.label, stage.entry->name, stage.entry->type, needs.most_parameters,
                      run.assembly->layout().parameters.size()));
    check_constraints(run, stage, needs);
    if (needs.gradient && run.assembly->layout().derivatives_missing)
      warnings.push_back({WarningKind::differenced_derivatives,
                          fmt::format("derivatives for '{}' are differences of whole predictions, because the model or "
                                      "a test has no exact ones",
                                      stage.entry->name),
                          run.label,
                          {stage.entry->name}});
  }
  if (run.assembly->layout().blocks.empty() && is_measured(run.assembly->layout()))
    throw InputError(fmt::format(
        "run {}: no row is left to fit: every row is held out. Set hold_out to false in a test", run.label));
  if (is_measured(run.assembly->layout()) && !is_weighed(run.assembly->layout()))
    throw InputError(fmt::format(
        "run {}: every row that could be fitted has the weight 0, so that there is nothing to fit; set \"weight\" "
        "above 0 in a test",
        run.label));
  if (!random && !run.entry->random_start && run.entry->realisations > 1)
    warnings.push_back({WarningKind::equal_realisations,
                        fmt::format("the optimiser uses no random numbers, so its {} realisations are all the same",
                                    run.entry->realisations),
                        run.label});
}

/// Keys that have no effect in this experiment.
void warn_of_idle_keys(const experiment::Experiment& experiment, const Plan& plan, std::vector<Warning>& warnings) {
  for (const PlannedRun& run : plan.runs)
    if (run.entry->fewer_simulations.guide && !run.assembly->layout().has_costly_tests)
      warnings.push_back(
          {WarningKind::set_up, "\"guide\" changes nothing, as no test of the run is costly: leave it out", run.label});
  if (!experiment.analysis.optimizer.empty() && !experiment.analysis.refits())
    warnings.push_back({WarningKind::set_up,
                        fmt::format("the optimizer '{}' of \"analysis\" changes nothing without refits: leave it out, "
                                    "or ask for \"profiles\" or \"bootstrap\"",
                                    experiment.analysis.optimizer)});
}

/// A model or mechanism with memory takes the rows for the whole loading path, whether or not the file says so.
void warn_of_assumed_orders(const experiment::Experiment& experiment, const PlannedRun& run,
                            const plugins::Catalogue& catalogue, std::vector<Warning>& warnings) {
  std::vector<assembly::TestPast> assumed;
  Warning warning{WarningKind::order_assumed, {}, run.label};
  for (const assembly::TestPast& one : assembly::unknown_pasts(experiment, *run.entry, catalogue))
    if (assembly::has_memory(experiment, experiment.test(one.test), *run.entry, catalogue)) {
      assumed.push_back(one);
      warning.subjects.push_back(one.test);
    }
  if (std::string words = assembly::ramp_words(experiment, *run.entry, catalogue); !words.empty())
    warnings.push_back({WarningKind::order_assumed, std::move(words), run.label});
  if (assumed.empty()) return;
  warning.sentence = assembly::assumption_words(assumed);
  warnings.push_back(std::move(warning));
}

/// The plugins behind every model, test, mechanism and optimiser of the experiment.
std::vector<std::string> used_plugins(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue) {
  std::set<std::string> used;
  const auto use = [&used](const auto& shelf, const std::string& type) {
    if (const auto found = shelf.find(type); found != shelf.end()) used.insert(found->second.plugin);
  };
  for (const auto& model : experiment.models) {
    use(catalogue.models(), model.type);
    for (const auto& mechanism : model.mechanisms) use(catalogue.mechanisms(), mechanism.type);
  }
  for (const auto& test : experiment.tests) {
    use(catalogue.tests(), test.type);
    for (const auto& mechanism : test.mechanisms) use(catalogue.mechanisms(), mechanism.type);
  }
  for (const auto& optimizer : experiment.optimizers) use(catalogue.optimizers(), optimizer.type);
  return {used.begin(), used.end()};
}

/// The properties that runs must share if their searches are to begin at the same points.
std::string box_of(const assembly::Layout& layout) {
  std::string text;
  for (const auto& parameter : layout.parameters)
    text += fmt::format("{} {} {} {}\n", parameter.name, parameter.min, parameter.max,
                        parameter.scale == Scale::log ? "log" : "linear");
  return text;
}

/// Reports paired starts that no two runs can share.
void warn_of_unpaired_starts(Plan& plan) {
  std::set<std::uint64_t> seeds;
  for (const auto& run : plan.runs)
    if (run.paired_seed && !seeds.insert(*run.paired_seed).second) return;
  if (!seeds.empty())
    plan.warnings.push_back({WarningKind::set_up,
                             "\"paired_starts\" pairs nothing: no two runs have the same free parameters with the "
                             "same bounds and scales"});
}

}  // namespace

EvaluationTable Plan::table() const {
  std::vector<RunColumns> columns;
  for (const auto& run : runs) {
    auto& column = columns.emplace_back();
    column.label = run.label;
    for (const auto& parameter : run.assembly->layout().parameters)
      column.parameters.emplace_back(parameter.name, parameter.unit);
    column.tests = run.entry->tests;
  }
  return EvaluationTable(std::move(columns));
}

Plan make_plan(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue) {
  Plan plan;
  plan.plugins = used_plugins(experiment, catalogue);
  plan.experiment = &experiment;
  std::map<std::string, int> seen;
  for (const auto& entry : experiment.runs) {
    auto& run = plan.runs.emplace_back();
    const std::string pair = experiment.model_name(entry) + '/' + entry.optimizer;
    const int occurrence = ++seen[pair];
    run.label = occurrence == 1 ? pair : fmt::format("{}#{}", pair, occurrence);
    run.entry = &entry;
    run.seed = derive_seed(experiment.seed, fmt::format("run {}#{}", pair, occurrence));
    run.stages = plan_stages(experiment, entry, catalogue);
    run.assembly = std::make_unique<assembly::Assembly>(experiment, entry, catalogue);
    if (experiment.paired_starts)
      run.paired_seed = derive_seed(experiment.seed, "starts in " + box_of(run.assembly->layout()));
    if (entry.fewer_simulations.guide)
      run.guide = assembly::make_guide(experiment, entry, run.label, catalogue, *run.assembly);
    check_needs(run, plan.warnings);
    warn_of_assumed_orders(experiment, run, catalogue, plan.warnings);
    for (std::uint64_t realisation = 1; realisation <= entry.realisations; ++realisation)
      plan.tasks.push_back({plan.runs.size() - 1, realisation});
  }
  warn_of_idle_keys(experiment, plan, plan.warnings);
  warn_of_unpaired_starts(plan);
  return plan;
}

}  // namespace tunica::execution
