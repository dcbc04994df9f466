// SPDX-License-Identifier: Apache-2.0
#include "comparison/run_differences.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/enum_names.hpp"
#include "text/lists.hpp"

namespace tunica::comparison {

namespace {

/// Everything that two runs of one pair can differ in, always in this order, in words that need no key.
std::vector<std::string> aspects(const experiment::RunEntry& run) {
  const auto limit = [](const char* name, const auto& value) {
    return value ? fmt::format("{} {:g}", name, static_cast<double>(*value)) : fmt::format("no {}", name);
  };
  const std::string constraints = constraints_in_words(run);
  return {"on " + text::joined(run.tests),
          std::string(text::code_of(experiment::objective_names, run.objective)),
          constraints.empty() ? "free" : constraints,
          fmt::format("max_evaluations {}", run.stop.max_evaluations),
          limit("max_time", run.stop.max_time),
          limit("target", run.stop.target),
          limit("stall", run.stop.stall),
          run.random_start ? "initial random" : "initial given",
          text::counted(run.realisations, "realisation", "realisations"),
          run.fewer_simulations.early_end ? "early_end" : "no early_end",
          run.fewer_simulations.guide ? "guide" : "no guide"};
}

/// Constraints whose words are the same can differ in their range.
std::string all_of(const experiment::RunEntry& run) {
  std::string text = fmt::format("{}", fmt::join(aspects(run), "\n"));
  for (const auto& constraint : run.constraints) text += '\n' + constraint.json;
  return text;
}

}  // namespace

std::string constraints_in_words(const experiment::RunEntry& run) {
  std::vector<std::string> words;
  for (const auto& constraint : run.constraints) {
    if (constraint.type != "transverse_stability")
      words.emplace_back("admissible");
    else if (constraint.h.size() > 1)
      words.emplace_back("h(stretch)");
    else
      words.push_back(fmt::format("h = {:g}", constraint.h.front().second));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::vector<std::vector<std::string>> run_differences(const execution::Plan& plan) {
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> pairs;
  for (std::size_t run = 0; run < plan.runs.size(); ++run) {
    const auto& entry = *plan.runs[run].entry;
    pairs[{plan.experiment->model_name(entry), entry.optimizer}].push_back(run);
  }
  std::vector<std::vector<std::string>> differences(plan.runs.size());
  for (const auto& [pair, runs] : pairs) {
    if (runs.size() < 2) continue;
    std::vector<std::vector<std::string>> all;
    for (const std::size_t run : runs) all.push_back(aspects(*plan.runs[run].entry));
    std::set<std::string> seen;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const auto& entry = *plan.runs[runs[k]].entry;
      auto& own = differences[runs[k]];
      for (std::size_t a = 0; a < all[k].size(); ++a)
        if (std::any_of(all.begin(), all.end(), [&](const auto& other) { return other[a] != all[k][a]; }))
          own.push_back(all[k][a]);
      const auto same_words = [&](std::size_t other) { return other != k && all[other] == all[k]; };
      bool ranges = false;
      for (std::size_t other = 0; other < runs.size(); ++other)
        ranges = ranges || (same_words(other) && all_of(*plan.runs[runs[other]].entry) != all_of(entry));
      if (ranges)
        for (const auto& constraint : entry.constraints) own.push_back(constraint.json);
      if (!seen.insert(all_of(entry)).second) own.emplace_back("other seed");
    }
  }
  return differences;
}

std::vector<std::vector<std::string>> paired_runs(const execution::Plan& plan) {
  std::vector<std::vector<std::string>> paired(plan.runs.size());
  for (std::size_t run = 0; run < plan.runs.size(); ++run)
    for (const auto& other : plan.runs)
      if (&other != &plan.runs[run] && other.paired_seed && other.paired_seed == plan.runs[run].paired_seed)
        paired[run].push_back(other.label);
  return paired;
}

}  // namespace tunica::comparison
