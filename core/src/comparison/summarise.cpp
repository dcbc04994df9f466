// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "comparison/estimate.hpp"
#include "comparison/ranking.hpp"
#include "comparison/run_differences.hpp"
#include "comparison/stability_report.hpp"
#include "comparison/success.hpp"
#include "comparison/summary.hpp"
#include "comparison/warnings.hpp"
#include "plugins/limited_work.hpp"
#include "text/lists.hpp"

namespace tunica::comparison {

namespace {

/// The realisation with the best evaluated point; the first of equals.
const execution::RealisationResult* best_of(const execution::RunResult& result) {
  const execution::RealisationResult* best = nullptr;
  for (const auto& realisation : result.realisations)
    if (realisation.best.found() && (!best || realisation.best.better_than(best->best))) best = &realisation;
  return best;
}

/// The trace holds every improvement: where random numbers play a part, two are never the same. Realisations that the
/// optimiser's own error ended have half a trace, and count for nothing here.
bool one_course(const execution::RunResult& result) {
  std::vector<const execution::RealisationResult*> all;
  for (const auto& realisation : result.realisations)
    if (realisation.stopped_by != search::StopReason::optimizer_failure) all.push_back(&realisation);
  return all.size() > 1 && !all.front()->trace.empty() &&
         std::all_of(all.begin() + 1, all.end(), [&](const auto* other) {
           return std::equal(other->trace.begin(), other->trace.end(), all.front()->trace.begin(),
                             all.front()->trace.end(), [](const auto& a, const auto& b) {
                               return a.evaluations == b.evaluations && a.objective == b.objective;
                             });
         });
}

/// The failure policy ended it.
bool gave_up(search::StopReason reason) {
  return reason == search::StopReason::failure || reason == search::StopReason::failure_rate;
}

void add_counts(const execution::RunResult& result, RunSummary& summary) {
  std::vector<double> objectives;
  search::Tally total;
  for (const auto& realisation : result.realisations) {
    total.add(realisation.tally);
    summary.seconds += realisation.seconds;
    if (realisation.stopped_by == search::StopReason::optimizer_failure && summary.faults++ == 0)
      summary.first_fault = realisation.reason;
    summary.given_up += gave_up(realisation.stopped_by);
    if (realisation.best.feasible()) objectives.push_back(realisation.best.objective);
  }
  summary.evaluations = total.evaluations;
  summary.jacobians = total.jacobians;
  summary.failures = total.failures;
  summary.infeasible = total.infeasible;
  summary.simulated = total.simulated;
  summary.ended_early = total.ended_early;
  summary.guide_evaluations = total.guide_evaluations;
  summary.first_failure = total.first_failure;
  summary.failure_reasons = total.reasons;
  std::stable_sort(summary.failure_reasons.begin(), summary.failure_reasons.end(),
                   [](const auto& a, const auto& b) { return a.count > b.count; });
  summary.realisations = result.realisations.size();
  summary.one_course = one_course(result);
  summary.objectives = sample_statistics(objectives);
}

/// How many searches ended at each bound: starts of the optimiser, or realisations where it tells of none.
void add_bound_stops(const assembly::Assembly& assembly, const execution::RunResult& result, RunSummary& summary) {
  search::Tally all;
  std::vector<double> x(summary.parameters.size());
  for (const auto& realisation : result.realisations) {
    if (realisation.tally.starts > 0) {
      all.add(realisation.tally);
    } else if (realisation.best.feasible()) {
      assembly.box().to_unit(realisation.best.parameters, x);
      all.add_start(x, realisation.best.objective);
    }
  }
  summary.searches = all.starts;
  for (const auto& stops : all.bound_stops) {
    Estimate& estimate = summary.parameters[stops.parameter];
    (stops.upper ? estimate.stops_upper : estimate.stops_lower) = {stops.count, stops.objective};
  }
}

/// "test 'strip': 34 solver runs, 2 failed runs until the search had ended"
void add_effort_notes(RunSummary& summary) {
  for (const auto& [test, efforts] : summary.efforts) {
    std::string words;
    for (const Effort& effort : efforts) {
      std::string name = effort.name;
      std::replace(name.begin(), name.end(), '_', ' ');
      words += fmt::format("{}{} {}", words.empty() ? "" : ", ", effort.count, name);
    }
    if (!words.empty()) summary.notes.push_back(fmt::format("test '{}': {} until the search had ended", test, words));
  }
}

/// "1200 evaluations took 310 full simulations; 850 ended early, …"
std::string words_on_simulations(const RunSummary& summary) {
  std::string words = fmt::format("{} evaluations took {} full simulations", summary.evaluations, summary.simulated);
  if (summary.ended_early > 0) words += fmt::format("; {} ended early at their cheap tests", summary.ended_early);
  if (summary.guide_evaluations > 0)
    words +=
        fmt::format("; the cheaper tests that guided the search were evaluated {} times", summary.guide_evaluations);
  return words;
}

RunSummary summarise_run(const experiment::Experiment& experiment, const execution::PlannedRun& run,
                         const execution::RunResult& result, std::vector<execution::Warning>& warnings) {
  RunSummary summary;
  summary.label = run.label;
  summary.model = experiment.model_name(*run.entry);
  summary.optimizer = run.entry->optimizer;
  summary.tests = run.entry->tests;
  summary.objective_type = name_of(run.entry->objective);
  summary.group = group_of(*run.entry);
  summary.target = run.entry->stop.target;
  summary.fixed = run.assembly->layout().fixed_parameters;
  add_counts(result, summary);
  summary.efforts = run.assembly->evaluator().efforts();
  const auto* best = best_of(result);
  const auto* told = best ? best : result.realisations.empty() ? nullptr : &result.realisations.front();
  if (told) {
    summary.converged = told->converged;
    summary.reason = told->reason;
    summary.stopped_by = told->stopped_by;
    summary.stop_sentence = told->stop_sentence;
    summary.limit = limit_of(run, summary);
  }
  if (!best) {
    summary.status = Status::failed(!summary.first_failure.empty() ? summary.first_failure
                                    : !summary.first_fault.empty() ? summary.first_fault
                                                                   : "nothing was evaluated");
    return summary;
  }
  summary.has_result = true;
  summary.best_realisation = best->realisation;
  summary.best_id = best->best.index + 1;
  summary.objective = best->best.objective;
  estimate(experiment, *run.assembly, *best, result, summary, warnings,
           plugins::deadline_after(run.entry->stop.max_time));
  add_bound_stops(*run.assembly, result, summary);
  add_effort_notes(summary);
  summary.has_costly_tests = run.assembly->layout().has_costly_tests;
  if (summary.has_costly_tests) summary.notes.push_back(words_on_simulations(summary));
  summary.information = information(*run.assembly, run.entry->objective, best->best.parameters);
  if (best->best.feasible())
    add_agreement(*run.assembly, result, summary.objective, run.entry->stop.target, summary.certificate);
  summary.certificate.ended_at_target = best->stopped_by == search::StopReason::target;
  for (const auto& parameter : summary.parameters)
    if (parameter.at_bound != Estimate::Bound::none) summary.certificate.at_bounds.push_back(parameter.name);
  return summary;
}

/// Runs that end at the same point say the same: once, with all their labels.
std::vector<std::string> merge_sentences(const std::vector<RunSummary>& runs) {
  std::vector<std::pair<std::string, std::string>> said;  // sentence, labels
  for (const auto& run : runs)
    for (const auto& sentence : run.identifiability) {
      const auto same =
          std::find_if(said.begin(), said.end(), [&](const auto& entry) { return entry.first == sentence; });
      if (same == said.end())
        said.emplace_back(sentence, run.label);
      else
        same->second.append(", ").append(run.label);
    }
  std::vector<std::string> sentences;
  for (const auto& [sentence, labels] : said) sentences.push_back(fmt::format("{}: {}", labels, sentence));
  return sentences;
}

}  // namespace

Summary summarise(const execution::Plan& plan, const std::vector<execution::RunResult>& results,
                  const std::vector<std::string>& refusals, const Told& told) {
  Summary summary;
  summary.name = plan.experiment->name;
  std::vector<execution::Warning> mismatches;
  const auto differences = run_differences(plan), paired = paired_runs(plan);
  for (std::size_t run = 0; run < plan.runs.size(); ++run) {
    if (told) told(fmt::format("the best point of {}", plan.runs[run].label));
    summary.runs.push_back(summarise_run(*plan.experiment, plan.runs[run], results[run], mismatches));
    summary.runs.back().differs = differences[run];
    summary.runs.back().paired_starts = plan.experiment->paired_starts;
    summary.runs.back().paired_with = paired[run];
    if (!paired[run].empty())
      summary.runs.back().notes.push_back("its searches begin at the same points as those of " +
                                          text::joined(paired[run]));
  }
  count_successes(plan, results, summary.runs);
  summary.ranking = rank(summary.runs);
  compare_information(summary.runs, summary.ranking);
  if (told) told("stability");
  add_stability(plan, summary);
  summary.identifiability = merge_sentences(summary.runs);
  const auto add = [&](const execution::Warning& warning) {
    auto& all = summary.warnings;
    const auto same = [&](const auto& other) { return other.text() == warning.text(); };
    if (std::none_of(all.begin(), all.end(), same)) all.push_back(warning);
  };
  const auto own = warnings_of(plan, summary.runs, summary.ranking);
  const auto first = [](const execution::Warning& warning) {
    using Kind = execution::WarningKind;
    constexpr std::array kinds{Kind::no_feasible_point, Kind::misfit_out_of_scale, Kind::no_misfit,
                               Kind::noise_contradicted, Kind::noise_too_large};
    return std::find(kinds.begin(), kinds.end(), warning.kind) != kinds.end();
  };
  for (const auto& warning : own)
    if (first(warning)) add(warning);
  for (const auto& warning : mismatches) add(warning);
  for (const auto& warning : own) add(warning);
  for (const auto& refusal : refusals) add({execution::WarningKind::plugin_refused, refusal});
  for (const auto& warning : plan.warnings) add(warning);
  for (const auto& run : plan.runs) {
    for (const auto& finding : run.assembly->layout().findings) add(execution::warning_of(finding));
    for (const auto& warning : run.assembly->layout().warnings) add({execution::WarningKind::set_up, warning});
  }
  return summary;
}

}  // namespace tunica::comparison
