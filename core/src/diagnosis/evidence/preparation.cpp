// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/preparation.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/memory.hpp"
#include "data/quantities.hpp"
#include "diagnosis/evidence/gross_rows.hpp"
#include "tunica/error.hpp"

namespace tunica::diagnosis {
namespace {

/// The tests of that run, or all.
std::vector<std::string> tests_of(const experiment::Experiment& experiment, const experiment::RunEntry* run) {
  if (run != nullptr) return run->tests;
  std::vector<std::string> names;
  for (const auto& test : experiment.tests) names.push_back(test.name);
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Settings of the run that a diagnosis ignores.
std::optional<Warning> constraints_warning(const experiment::RunEntry* run) {
  if (run == nullptr || run->constraints.empty()) return std::nullopt;
  std::vector<std::string> types;
  for (const experiment::ConstraintEntry& constraint : run->constraints) types.push_back(constraint.type);
  return Warning{WarningKind::constraints_not_applied,
                 fmt::format("the constraints of the run ({}) do not apply to the fits of a diagnosis: a constraint "
                             "that holds a fit back would look like a misfit of the model. Lost stability is reported; "
                             "set \"admissibility\": true to have it count as a misfit",
                             fmt::join(types, ", "))};
}

struct Weightless {
  experiment::Experiment experiment;
  std::vector<Warning> warnings;
};

/// A run weights channels by their weights, a diagnosis by their noise. But a channel of weight 0 takes no part.
Weightless without_weights(experiment::Experiment experiment, const std::vector<std::string>& tests,
                           const plugins::Catalogue& catalogue) {
  std::vector<Warning> warnings;
  for (auto& test : experiment.tests) {
    const std::vector<double> weights = std::exchange(test.weights, {});
    if (!contains(tests, test.name) || std::find(weights.begin(), weights.end(), 0.0) == weights.end()) continue;
    const auto& observables = catalogue.tests().find(test.type)->second.factory.observables;
    const auto channels = data::read_dataset(test.data, observables).channels;
    std::vector<std::string> silent;
    if (!test.data.tables.empty()) {  // a measured field moves its edges, whatever it weighs
      warnings.push_back({WarningKind::channel_without_weight,
                          fmt::format("test '{}': a channel has weight 0 and takes part in the diagnosis all the same, "
                                      "since the data are in several tables. Take its column out to leave it out",
                                      test.name)});
      continue;
    }
    for (std::size_t k = 0; k < weights.size(); ++k)
      if (weights[k] == 0) silent.push_back(channels[k].observable);
    warnings.push_back({WarningKind::channel_without_weight,
                        fmt::format("test '{}': {} has weight 0 and takes no part. Give it a weight to include it",
                                    test.name, fmt::join(silent, " and "))});
    if (silent.size() == channels.size()) {
      test.hold_out.all = true;
      continue;
    }
    std::erase_if(test.data.columns, [&](const auto& entry) {
      return contains(silent, data::quantity_named(entry.first, observables)->observable->name);
    });
    std::erase_if(test.data.noise, [&](const auto& entry) { return contains(silent, entry.first); });
  }
  return {std::move(experiment), std::move(warnings)};
}

/// Whether a mechanism with memory was requested by name. Rows then keep their order, as under a base with memory.
bool asks_for_memory(const Inquiry& inquiry) {
  const std::vector<std::string>& asked = inquiry.request.mechanisms;
  return std::any_of(asked.begin(), asked.end(),
                     [&](const std::string& id) { return assembly::has_memory(inquiry.mechanism(id)); });
}

struct Ordered {
  experiment::Experiment experiment;
  std::vector<Warning> warnings;
};

/// Rows of unknown order are sorted by their values, so results cannot depend on their order in the file. Only models
/// and mechanisms with memory need the file's order, and a warning then says so.
Ordered with_orders(const Inquiry& inquiry, experiment::Experiment experiment, const experiment::RunEntry& run) {
  const bool asked = asks_for_memory(inquiry);
  std::vector<assembly::TestPast> assumed;
  for (const assembly::TestPast& one : assembly::unknown_pasts(experiment, run, inquiry.catalogue)) {
    auto& entries = experiment.tests;
    auto& entry =
        *std::find_if(entries.begin(), entries.end(), [&](const auto& test) { return test.name == one.test; });
    if (asked || assembly::has_memory(experiment, entry, run, inquiry.catalogue))
      assumed.push_back(one);
    else
      entry.data.sorted = one.past == data::Past::order_unknown;
  }
  std::vector<Warning> warnings;
  if (!assumed.empty()) warnings.push_back({WarningKind::order_assumed, assembly::assumption_words(assumed)});
  const bool sought = asked || (inquiry.request.mechanisms.empty() && inquiry.request.considers("material"));
  if (std::string words = assembly::ramp_words(experiment, run, inquiry.catalogue, sought); !words.empty())
    warnings.push_back({WarningKind::order_assumed, std::move(words)});
  return {std::move(experiment), std::move(warnings)};
}

}  // namespace

Preparation prepare(const Inquiry& inquiry, const std::vector<GrossRow>& gross) {
  Preparation prepared;
  experiment::RunEntry& run = prepared.run;
  const experiment::RunEntry* const fitted = run_of_model(inquiry.experiment, inquiry.request.model);
  run.model = inquiry.request.model;
  run.tests = tests_of(inquiry.experiment, fitted);
  run.optimizer = inquiry.request.optimizer;
  run.objective = experiment::ObjectiveType::least_squares;

  Ordered ordered = with_orders(inquiry, inquiry.experiment, run);
  Weightless weightless = without_weights(std::move(ordered.experiment), run.tests, inquiry.catalogue);
  prepared.warnings = std::move(ordered.warnings);
  std::move(weightless.warnings.begin(), weightless.warnings.end(), std::back_inserter(prepared.warnings));
  prepared.noise = noise_sources(weightless.experiment, run.tests, inquiry.catalogue, gross);
  prepared.experiment = without_rows(with_noise(std::move(weightless.experiment), run.tests, prepared.noise), gross);
  prepared.base = std::make_shared<const assembly::Assembly>(prepared.experiment, run, inquiry.catalogue);
  prepared.curves = curves_of(*prepared.base, prepared.noise);
  if (prepared.curves.empty())
    throw InputError(
        "diagnosis: every test is held out, which leaves nothing to diagnose. Set hold_out to false in "
        "at least one test");
  if (prepared.base->layout().parameters.size() >= prepared.base->layout().residual_count)
    throw InputError(
        fmt::format("diagnosis: {} parameters are fitted to {} rows, which leaves nothing to test the model with. Fix "
                    "parameters or give more rows",
                    prepared.base->layout().parameters.size(), prepared.base->layout().residual_count));

  if (auto warning = constraints_warning(fitted)) prepared.warnings.push_back(std::move(*warning));
  for (const auto& test : prepared.experiment.tests)
    if (test.hold_out.all && contains(run.tests, test.name))
      prepared.warnings.push_back(
          {WarningKind::test_held_out,
           fmt::format("test '{}' is held out and takes no part. Set hold_out to false to include it", test.name)});
  if (!gross.empty())
    prepared.warnings.push_back(
        {WarningKind::gross_rows_left_out,
         fmt::format("left out as gross errors: {}. Look at them in residuals.csv", words_of(gross))});
  return prepared;
}

}  // namespace tunica::diagnosis
