// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "diagnosis/output/fitted_experiment.hpp"
#include "diagnosis/output/outputs.hpp"
#include "experiment/reader.hpp"
#include "plugins/default_options.hpp"

namespace tunica::diagnosis {
namespace {

using experiment::Experiment;
using experiment::MechanismEntry;

/// A run takes rows as the file has them, a diagnosis those of unknown order by their values.
void count_rows_as_the_file(Experiment& experiment, const Addition& addition) {
  if (!addition.place.row) return;
  for (auto& test : experiment.tests)
    if (test.name == addition.place.tests.front())
      for (MechanismEntry& entry : test.mechanisms)
        if (entry.name() == addition.name())
          entry.options.set("rows", fmt::format("{}:{}:1", addition.place.file_row, addition.place.file_row + 1));
}

/// A gross row that was left out gets a shift of its own, which leaves it out of a run as well.
void add_gross_rows(Experiment& experiment, const std::vector<Cause>& rows, const plugins::Catalogue& catalogue) {
  for (const Cause& row : rows)
    for (auto& test : experiment.tests) {
      if (test.name != row.place.tests.front()) continue;
      MechanismEntry entry{row.id, {}, {}};
      entry.options = plugins::default_options(catalogue.mechanisms().at(row.id).factory.options);
      entry.options.set("channel", row.place.channel);
      entry.options.set("rows", fmt::format("{}:{}:1", row.place.file_row, row.place.file_row + 1));
      experiment::ParameterSetting& shift = entry.parameters[row.amplitude.name];
      shift.initial = row.amplitude.value;
      if (const double wide = 5 * std::abs(row.amplitude.value); wide > 0) {
        shift.min = -wide;
        shift.max = wide;
      }
      test.mechanisms.push_back(std::move(entry));
    }
}

}  // namespace

std::string extended_experiment(const Diagnosis& d, const plugins::Catalogue& catalogue) {
  if (!d.explanation.claim.best) return {};
  const Refit& best = *d.explanation.claim.best;
  Experiment experiment = with_shares(*best.extension, catalogue);
  for (const Addition& addition : best.additions) count_rows_as_the_file(experiment, addition);
  add_gross_rows(experiment, d.explanation.left_out, catalogue);
  return experiment::write_input(
      fitted_experiment(std::move(experiment), d.analysis.evidence.run, best.extension->assembly(), best.fit.free,
                        d.request.optimizer, catalogue),
      catalogue);
}

}  // namespace tunica::diagnosis
