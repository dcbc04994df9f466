// SPDX-License-Identifier: Apache-2.0
#include "comparison/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "comparison/draw_journal.hpp"
#include "comparison/fit_table.hpp"
#include "comparison/posterior_output.hpp"
#include "comparison/provenance.hpp"
#include "comparison/uncertainty_tables.hpp"
#include "comparison/uncertainty_words.hpp"
#include "data/nearest.hpp"
#include "plugins/default_options.hpp"
#include "plugins/limited_work.hpp"
#include "tunica/detail/vector_level.hpp"
#include "tunica/error.hpp"
#include "tunica/random.hpp"
#include "uncertainty/bootstrap.hpp"
#include "uncertainty/profile.hpp"

namespace tunica::comparison {

namespace {

uncertainty::LocalOptimizer local_optimizer(const experiment::Experiment& experiment,
                                            const plugins::Catalogue& catalogue) {
  const std::string& named = experiment.analysis.optimizer;
  if (!named.empty()) {
    const experiment::OptimizerEntry& entry = experiment.optimizer(named);
    return {&catalogue.optimizers().find(entry.type)->second, entry.options};
  }
  const auto* const refiner = catalogue.refiner();
  if (refiner == nullptr)
    throw InputError(
        fmt::format("{} (/analysis): refits need an optimizer that goes down from a start, and no plugin provides one; "
                    "name one of \"optimizers\" in analysis.optimizer",
                    experiment.file.string()));
  Options options = plugins::default_options(refiner->factory.options);
  options.set("starts", std::int64_t{1});
  return {refiner, std::move(options)};
}

/// What makes the draws of a plan, beside the question that they answer.
std::string program_of(const execution::Plan& plan) {
  return fmt::format("tunica {}, {}, {}", version(), detail::name(detail::vector_level()),
                     fmt::join(plan.plugins, ", "));
}

std::vector<std::size_t> wanted(const experiment::Analysis& analysis, const assembly::Assembly& assembly) {
  std::vector<std::size_t> indices;
  for (std::size_t j = 0; j < assembly.layout().parameters.size(); ++j) {
    const auto& names = analysis.profiles;
    const bool named = std::find(names.begin(), names.end(), assembly.layout().parameters[j].name) != names.end();
    if (analysis.all_profiles || named) indices.push_back(j);
  }
  return indices;
}

void keep(const std::vector<uncertainty::Profile>& made, RunSummary& summary) {
  for (const auto& profile : made) {
    auto& estimate = summary.parameters[profile.parameter];
    const auto end = [](const uncertainty::Profile::End& side) {
      return side.kind == uncertainty::Profile::End::Kind::crossed ? std::optional(side.value) : std::nullopt;
    };
    estimate.profile = ProfileInterval{end(profile.lower), end(profile.upper)};
  }
}

/// What is said where profiles or draws are not there because time was over.
void say_left_out(const std::string& what, double max_time, RunSummary& run) {
  run.uncertainty.push_back(fmt::format(
      "{}: max_time of {:g} s was over, which the analysis of a run may take as well. Raise \"max_time\" in "
      "\"stop\", or ask for less",
      what, max_time));
}

void add_words(RunSummary& run) {
  if (!run.withheld.empty()) {
    run.uncertainty.insert(run.uncertainty.begin(), "no intervals: " + run.withheld);
    return;
  }
  add_linearised_words(run);
  add_widening_words(run);
}

}  // namespace

void check_analysis(const execution::Plan& plan, const plugins::Catalogue& catalogue) {
  const auto& analysis = plan.experiment->analysis;
  std::vector<std::string> known;
  for (const auto& run : plan.runs)
    for (const auto& parameter : run.assembly->layout().parameters)
      if (std::find(known.begin(), known.end(), parameter.name) == known.end()) known.push_back(parameter.name);
  for (const auto& name : analysis.profiles)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("{}: no run searches for the parameter '{}' that a profile is asked of. {}",
                                   analysis.profile_place(name), name, data::suggestion(name, known)));
  for (const auto& name : analysis.stability_map)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("{}: no run searches for the parameter '{}' of the stability map. {}",
                                   analysis.map_places.at(name), name, data::suggestion(name, known)));
  if (const auto& map = analysis.stability_map; !map.empty()) {
    if (map[0] == map[1])
      throw InputError(fmt::format("{}: '{}' is named twice in the stability map; a map has two parameters",
                                   analysis.map_places.at(map[0]), map[0]));
    const bool possible = std::any_of(plan.runs.begin(), plan.runs.end(), [&](const auto& run) {
      const auto& free = run.assembly->layout().parameters;
      return std::all_of(map.begin(), map.end(), [&](const auto& name) {
        return std::any_of(free.begin(), free.end(), [&](const auto& parameter) { return parameter.name == name; });
      });
    });
    if (!possible)
      throw InputError(fmt::format(
          "{}: no run searches for both '{}' and '{}', the parameters of the stability map; free both in one",
          analysis.map_places.at(map[0]), map[0], map[1]));
  }
  if (analysis.refits()) static_cast<void>(local_optimizer(*plan.experiment, catalogue));
}

void analyse(const execution::Plan& plan, const plugins::Catalogue& catalogue, const std::filesystem::path& directory,
             const std::function<bool()>& interrupted, const Told& told, Summary& summary) {
  const auto& analysis = plan.experiment->analysis;
  if (!analysis.wanted()) {
    for (auto& run : summary.runs) add_words(run);
    return;
  }
  uncertainty::LocalOptimizer optimizer;
  if (analysis.refits()) optimizer = local_optimizer(*plan.experiment, catalogue);
  bool has_posterior = false;
  std::vector<RunProfiles> profiled;
  std::vector<RunDraws> drawn;
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const auto& run = plan.runs[k];
    auto& own = summary.runs[k];
    if (!own.has_result || !own.status.ok() || !own.withheld.empty()) {
      add_words(own);
      continue;
    }
    const auto& assembly = *run.assembly;
    std::vector<double> best;
    for (const auto& parameter : own.parameters) best.push_back(parameter.value);
    const std::uint64_t seed = derive_seed(run.seed, "analysis");
    const std::optional<double> max_time = run.entry->stop.max_time;
    const plugins::LimitedWork work("analysis", plugins::deadline_after(max_time));
    if (const auto indices = wanted(analysis, assembly); !indices.empty()) {
      if (told) told("profiles of " + own.label);
      const auto likelihood = uncertainty::likelihood_at(assembly, best, optimizer, seed);
      if (work.is_over()) {
        say_left_out("no profiles", *max_time, own);
      } else if (!likelihood.centre.status.ok()) {
        own.uncertainty.push_back(
            fmt::format("no profiles: the best point cannot be refitted: {}", likelihood.centre.status.reason()));
      } else {
        auto made = uncertainty::profiles(assembly, likelihood, optimizer, indices, seed, interrupted);
        if (work.is_over()) {  // ends that were not reached are no ends
          say_left_out("no profiles", *max_time, own);
        } else {
          keep(made, own);
          add_profile_words(assembly, made, own);
          profiled.push_back({&assembly, own.label, std::move(made)});
        }
      }
    }
    if (analysis.bootstrap_draws > 0 && work.is_over()) {
      say_left_out("no bootstrap", *max_time, own);
    } else if (analysis.bootstrap_draws > 0) {
      if (told) told("bootstrap of " + own.label);
      auto made = uncertainty::bootstrap(assembly, best, optimizer, analysis.bootstrap_draws, seed, interrupted);
      const std::size_t found = made.draws.size();
      const bool cut = work.is_over() && found < analysis.bootstrap_draws;
      if (cut)
        say_left_out(fmt::format("{} of {} draws of the bootstrap", found, analysis.bootstrap_draws), *max_time, own);
      if (!cut || found > 0) {
        for (std::size_t j = 0; j < best.size(); ++j) own.parameters[j].bootstrap = made.ci95[j];
        add_bootstrap_words(assembly, made, own);
        drawn.push_back({&assembly, own.label, std::move(made)});
      }
    }
    if (analysis.posterior_draws > 0) {
      if (told) told("posterior of " + own.label);
      DrawJournal journal(directory / fmt::format("posterior_steps_{}.csv", file_stem(own.label)), program_of(plan));
      const auto over = [&] { return journal.has_failed() || (interrupted && interrupted()); };
      const auto made =
          posterior::sample(assembly, best, analysis.posterior_draws, seed, over, {}, analysis.discrepancy, &journal);
      journal.finish();
      if (!made.status.ok()) {
        own.uncertainty.push_back("no posterior: " + made.status.reason());
      } else if (!made.complete) {
        if (work.is_over()) say_left_out("no posterior", *max_time, own);
      } else {
        add_posterior(assembly, made, own, summary.warnings);
        own.posterior->file = write_posterior(directory, assembly, made, own.label);
        has_posterior = true;
      }
    }
    add_words(own);
    if (interrupted && interrupted()) return;
  }
  write_profiles(directory, profiled);
  write_bootstrap(directory, drawn);
  if (has_posterior) write_fit_tables(directory, plan, summary);  // with its bands
}

}  // namespace tunica::comparison
