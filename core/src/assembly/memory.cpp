// SPDX-License-Identifier: Apache-2.0
#include "assembly/memory.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/composition.hpp"
#include "text/lists.hpp"

namespace tunica::assembly {
namespace {

/// "'a', 'b' and 'c'": the tests with such a history; empty = none.
std::string tests_with(const std::vector<TestPast>& pasts, data::Past past) {
  std::vector<std::string> names;
  for (const TestPast& one : pasts)
    if (one.past == past) names.push_back(fmt::format("'{}'", one.test));
  return names.empty() ? std::string() : text::joined(names);
}

}  // namespace

std::vector<TestPast> unknown_pasts(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                                    const plugins::Catalogue& catalogue) {
  std::vector<TestPast> found;
  for (const std::string& name : run.tests) {
    const experiment::TestEntry& entry = experiment.test(name);
    const auto& observables = catalogue.tests().find(entry.type)->second.factory.observables;
    const data::Past past = data::past_of(data::read_dataset(entry.data, observables), observables);
    if (past != data::Past::known) found.push_back({name, past});
  }
  return found;
}

bool has_memory(const MechanismFactory& mechanism) { return mechanism.stage == Stage::history || mechanism.memory; }

std::vector<std::string> models_of_test(const experiment::TestEntry& test, const experiment::RunEntry& run) {
  if (test.layers.empty()) return {run.model};
  std::vector<std::string> models;
  for (const experiment::LayerEntry& layer : test.layers) models.push_back(layer.model);
  return models;
}

bool has_memory(const experiment::Experiment& experiment, const experiment::TestEntry& test,
                const experiment::RunEntry& run, const plugins::Catalogue& catalogue) {
  const auto remembers = [&](const experiment::MechanismEntry& entry) {
    const auto found = catalogue.mechanisms().find(entry.type);
    return found != catalogue.mechanisms().end() && has_memory(found->second.factory);
  };
  if (std::any_of(test.mechanisms.begin(), test.mechanisms.end(), remembers)) return true;
  const std::vector<std::string> models = models_of_test(test, run);
  return std::any_of(models.begin(), models.end(), [&](const std::string& name) {
    return compose_model(experiment.model(name), catalogue, "").model->describe().history_size > 0;
  });
}

std::string words_of(const std::vector<TestPast>& pasts) {
  const std::string unordered = tests_with(pasts, data::Past::order_unknown),
                    unloading = tests_with(pasts, data::Past::starts_unloading);
  std::string words;
  if (!unordered.empty())
    words = fmt::format(
        "nobody says in which order the rows of {} were measured; add \"order\": \"loading\" to their data, or map a "
        "time column",
        unordered);
  if (!unloading.empty())
    words += fmt::format(
        "{}the rows of {} start far from rest and unload, and what the specimen bore before is unknown; record the "
        "loading too",
        words.empty() ? "" : "; and ", unloading);
  return words;
}

std::string ramp_words(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                       const plugins::Catalogue& catalogue, bool sought) {
  std::vector<std::string> starts;
  for (const std::string& name : run.tests) {
    const experiment::TestEntry& entry = experiment.test(name);
    if (!sought && !has_memory(experiment, entry, run, catalogue)) continue;
    const auto& observables = catalogue.tests().find(entry.type)->second.factory.observables;
    if (const auto start = data::loaded_start_of(data::read_dataset(entry.data, observables), observables))
      starts.push_back(
          fmt::format("'{}', at a {} of {:.4g} after {:.4g} s", name, start->abscissa, start->value, start->time));
  }
  if (starts.empty()) return {};
  return fmt::format(
      "{}, and these tests begin under load: {}. A straight ramp from rest at time 0 is assumed before. Where the load "
      "came at once, let the clock begin there, so that the first row is at time 0; else record the loading too",
      sought ? "memory is looked for" : "something in the model has memory", text::joined(starts));
}

std::string assumption_words(const std::vector<TestPast>& pasts) {
  if (pasts.empty()) return {};
  return fmt::format("something in the model has memory, and the rows are taken for the whole loading path: {}",
                     words_of(pasts));
}

}  // namespace tunica::assembly
