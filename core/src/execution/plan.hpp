// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "execution/evaluation_table.hpp"
#include "execution/journal.hpp"
#include "execution/warning.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::execution {

/// One search within a run: the whole run, or one of its `stages`.
struct PlannedStage {
  const experiment::OptimizerEntry* entry = nullptr;
  const plugins::Catalogue::Entry<OptimizerFactory>* optimizer = nullptr;
  const experiment::Stop* own_stop = nullptr;  ///< of the stage; null = the run's
};

/// One entry of `runs`, ready to start.
struct PlannedRun {
  std::string label;  ///< "gho/es"; a second run of the same pair is "gho/es#2"
  const experiment::RunEntry* entry = nullptr;
  std::unique_ptr<assembly::Assembly> assembly;
  std::unique_ptr<assembly::Assembly> guide;  ///< the run with cheaper tests in place of costly ones, on request
  std::vector<PlannedStage> stages;
  std::uint64_t seed = 0;  ///< derive_seed(root, "run <model>/<optimizer>#<k>")
  /// The seed of the starting points, if the experiment pairs them. It is equal for runs whose free parameters have the
  /// same names, bounds and scales.
  std::optional<std::uint64_t> paired_seed = {};
};

/// Everything a run of the experiment does, checked before anything starts. Refers to the experiment and the
/// catalogue, which must outlive it.
struct Plan {
  const experiment::Experiment* experiment = nullptr;
  std::vector<PlannedRun> runs;
  std::vector<Task> tasks;  ///< in the order of evaluations.csv
  std::vector<Warning> warnings;

  std::vector<std::string> plugins;  ///< every one the results depend on, "gho 0.1.0", sorted

  [[nodiscard]] EvaluationTable table() const;
};

/// Throws InputError if data, names or an optimiser's needs do not match.
Plan make_plan(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue);

}  // namespace tunica::execution
