// SPDX-License-Identifier: Apache-2.0
#include "execution/realisation.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "plugins/guarded.hpp"
#include "plugins/usual_arithmetic.hpp"
#include "search/guided_search.hpp"
#include "search/random_point.hpp"
#include "tunica/random.hpp"

namespace tunica::execution {

namespace {

/// The stop block of a stage: its own limits, within what is left of the shared ones.
experiment::Stop stage_stop(const experiment::Stop& shared, const experiment::Stop* own, std::uint64_t used,
                            double elapsed) {
  experiment::Stop stop = own ? *own : shared;
  stop.max_evaluations = std::min(stop.max_evaluations, shared.max_evaluations - used);
  if (own && own->max_time) stop.max_time = *own->max_time + elapsed;  // counted from the start of the stage
  if (shared.max_time) stop.max_time = std::min(stop.max_time.value_or(*shared.max_time), *shared.max_time);
  if (!stop.target) stop.target = shared.target;
  if (!stop.stall) stop.stall = shared.stall;
  return stop;
}

/// One line, as in evaluations.csv. A resumed run therefore reports the same words.
std::string one_line(std::string text) {
  for (char& character : text)
    if (character == '\n' || character == '\r') character = ' ';
  return text;
}

/// Whether a limit of the whole realisation stopped the stage; otherwise the next stage begins.
bool ends_all(const RealisationResult& result, const experiment::Stop& shared) {
  switch (result.stopped_by) {
    case search::StopReason::none:
    case search::StopReason::stall:
      return false;
    case search::StopReason::target:
      return shared.target && result.best.feasible() && result.best.objective <= *shared.target;
    case search::StopReason::max_evaluations:
      return result.tally.evaluations >= shared.max_evaluations;
    case search::StopReason::max_time:
      return shared.max_time && result.seconds >= *shared.max_time;
    default:
      return true;
  }
}

}  // namespace

RealisationResult run_realisation(const PlannedRun& run, std::uint64_t realisation,
                                  const experiment::Experiment& experiment, const Surroundings& surroundings) {
  RealisationResult result;
  result.realisation = realisation;
  const std::uint64_t seed = derive_seed(run.seed, fmt::format("realisation {}", realisation));
  const std::uint64_t starts =
      derive_seed(run.paired_seed.value_or(run.seed), fmt::format("realisation {}", realisation));
  const auto& shared = run.entry->stop;
  const auto record = [&](const search::Record& entry) {
    result.seconds = std::max(result.seconds, entry.seconds);
    if (entry.status.ok() && !entry.ended_early &&
        (result.trace.empty() || entry.objective < result.trace.back().objective))
      result.trace.push_back({entry.index + 1, entry.objective});
    surroundings.record(entry);
  };
  for (std::size_t s = 0; s < run.stages.size(); ++s) {
    const auto& stage = run.stages[s];
    search::CalibrationProblem::Settings settings;
    settings.stop = stage_stop(shared, stage.own_stop, result.tally.evaluations, result.seconds);
    settings.on_failure = experiment.on_failure;
    settings.max_failure_rate = experiment.max_failure_rate;
    settings.seed =
        run.stages.size() == 1 ? seed : derive_seed(seed, fmt::format("stage {} {}", s + 1, stage.entry->name));
    settings.record = record;
    settings.replay = surroundings.replay;
    settings.interrupted = surroundings.interrupted;
    settings.first_index = result.tally.evaluations;
    settings.elapsed_before = result.seconds;
    if (run.paired_seed) settings.paired_starts = derive_seed(starts, fmt::format("stage {}", s + 1));
    if (run.entry->random_start)
      settings.start = search::random_point(starts, run.assembly->layout().parameters.size());
    if (!result.best.parameters.empty()) {
      settings.start.resize(result.best.parameters.size());
      run.assembly->box().to_unit(result.best.parameters, settings.start);
    }
    const auto optimizer = plugins::create(*stage.optimizer, stage.entry->options);
    settings.skip_costly = !plugins::needs(stage.optimizer->plugin, *optimizer).infeasible;
    settings.end_early = run.entry->fewer_simulations.early_end;
    search::CalibrationProblem problem(*run.assembly, settings);
    const auto minimise = [&](Optimizer& with, Problem& what) {
      return plugins::guarded(
          stage.optimizer->plugin, "minimise", [&] { return with.minimise(what); }, problem.seed("call"));
    };
    Optimizer::Outcome outcome;
    std::string fault;
    try {
      const plugins::UsualArithmetic arithmetic;
      if (run.guide) {
        search::GuidedSearch guided(*run.guide, settings, [&](Problem& cheap) {
          return minimise(*plugins::create(*stage.optimizer, stage.entry->options), cheap);
        });
        outcome = guided.run(problem, result.best.found());
        result.tally.guide_evaluations += guided.evaluations();
      } else {
        outcome = minimise(*optimizer, problem);
      }
    } catch (const plugins::HostFault&) {
      throw;
    } catch (const InputError& problem_of_plugin) {
      fault = problem_of_plugin.what();
    } catch (const plugins::MemoryLack& lack) {
      fault = lack.what();
      result.memory_lacked = true;
    } catch (const plugins::PluginFailure& problem_of_plugin) {
      fault = problem_of_plugin.what();
    }

    result.tally.add(problem.tally());
    const auto& best = problem.best();
    if (best.better_than(result.best)) result.best = best;
    result.converged = outcome.converged;
    result.reason = one_line(outcome.reason);
    result.stopped_by = problem.stop_reason();
    result.stop_sentence = one_line(problem.stop_sentence());
    if (!fault.empty()) {  // of this realisation; what it has found stays, and the others go on
      result.reason = one_line(fault);
      result.stopped_by = search::StopReason::optimizer_failure;
      result.stop_sentence = "failure of the optimiser";
      break;
    }
    if (ends_all(result, shared)) break;
  }
  result.tally.first_failure = one_line(result.tally.first_failure);
  for (auto& kind : result.tally.reasons) kind.example = one_line(kind.example);
  result.finished = !surroundings.interrupted();
  return result;
}

}  // namespace tunica::execution
