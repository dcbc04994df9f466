// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "execution/plan.hpp"
#include "execution/results.hpp"

namespace tunica::execution {

/// The inputs of a realisation.
struct Surroundings {
  std::function<void(const search::Record&)> record;
  search::Replay replay;
  std::function<bool()> interrupted;
};

/// Runs one realisation from its seed to its end. Its seed is derive_seed(run seed, "realisation <r>"); the optimiser's
/// purposes derive further seeds. `stages` share the budget. Each stage may have its own stop, and the next one starts
/// from the best evaluated point. The target, the shared budget, the time or an interruption ends all stages.
/// Convergence, stalling or a stage's own budget ends only that stage.
RealisationResult run_realisation(const PlannedRun& run, std::uint64_t realisation,
                                  const experiment::Experiment& experiment, const Surroundings& surroundings);

}  // namespace tunica::execution
