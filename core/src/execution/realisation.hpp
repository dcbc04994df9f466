// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "execution/plan.hpp"
#include "execution/results.hpp"

namespace tunica::execution {

/// What a realisation is given from outside.
struct Surroundings {
  std::function<void(const search::Record&)> record;
  search::Replay replay;
  std::function<bool()> interrupted;
};

/// Runs one realisation from its seed to its end: derive_seed(run seed, "realisation <r>"), then the purposes the
/// optimiser names. With `stages` the budget is shared, each stage may have a stop of its own, and the next one
/// starts from the best evaluated point; reaching the target, the shared budget, the time or an interruption ends
/// them all, while convergence, stalling or a stage's own budget ends only that stage.
RealisationResult run_realisation(const PlannedRun& run, std::uint64_t realisation,
                                  const experiment::Experiment& experiment, const Surroundings& surroundings);

}  // namespace tunica::execution
