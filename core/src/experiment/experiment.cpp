// SPDX-License-Identifier: Apache-2.0
#include "experiment/experiment.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tunica/error.hpp"

namespace tunica::experiment {
namespace {

// Names were checked when the file was read; asking for another one is a bug of the caller.
template <class Entry>
const Entry& named(const std::vector<Entry>& entries, std::string_view name) {
  for (const Entry& entry : entries)
    if (entry.name == name) return entry;
  throw std::out_of_range(fmt::format("the experiment has no entry '{}'", name));
}

}  // namespace

const ModelEntry& Experiment::model(std::string_view wanted) const { return named(models, wanted); }
const TestEntry& Experiment::test(std::string_view wanted) const { return named(tests, wanted); }
const StateEntry& Experiment::state(std::string_view wanted) const { return named(states, wanted); }
const OptimizerEntry& Experiment::optimizer(std::string_view wanted) const { return named(optimizers, wanted); }

std::vector<std::string> Experiment::models_of(const RunEntry& run) const {
  std::vector<std::string> names;
  if (!run.model.empty()) names.push_back(run.model);
  for (const std::string& used : run.tests)
    for (const LayerEntry& layer : test(used).layers)
      if (std::find(names.begin(), names.end(), layer.model) == names.end()) names.push_back(layer.model);
  return names;
}

std::vector<std::string> Experiment::states_of(const RunEntry& run) const {
  std::vector<std::string> names;
  for (const std::string& used : run.tests)
    if (const std::string& state = test(used).state;
        !state.empty() && std::find(names.begin(), names.end(), state) == names.end())
      names.push_back(state);
  return names;
}

Experiment measured_only(Experiment experiment) {
  for (RunEntry& run : experiment.runs)
    std::erase_if(run.tests, [&](const std::string& name) { return !experiment.test(name).measured; });
  std::erase_if(experiment.runs, [](const RunEntry& run) { return run.tests.empty(); });
  std::erase_if(experiment.tests, [](const TestEntry& test) { return !test.measured; });
  if (experiment.tests.empty())
    throw InputError(
        "no test has measured values, so there is nothing to diagnose. Map a measured quantity in "
        "\"columns\"");
  return experiment;
}

std::string Experiment::model_name(const RunEntry& run) const {
  return run.model.empty() ? fmt::format("{}", fmt::join(models_of(run), "+")) : run.model;
}

}  // namespace tunica::experiment
