// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stdexcept>
#include <string_view>

#include "assembly/assembly.hpp"
#include "experiment/experiment.hpp"
#include "plugins.hpp"
#include "plugins/guarded.hpp"
#include "tunica/random.hpp"

/// The problem the benchmarks run on: examples/lamb_aorta, two strips of 40 points, sum_of_norms.
namespace tunica::bench {

inline const experiment::Experiment& lamb_aorta() {
  static const experiment::Experiment read =
      experiment::read_experiment(TUNICA_SOURCE_DIR "/examples/lamb_aorta/experiment.json", catalogue());
  return read;
}

inline const experiment::RunEntry& run_of(std::string_view model, std::string_view optimizer) {
  for (const experiment::RunEntry& run : lamb_aorta().runs)
    if (run.model == model && run.optimizer == optimizer) return run;
  throw std::runtime_error("examples/lamb_aorta has no such run");
}

inline auto make_optimizer(std::string_view name) {
  const experiment::OptimizerEntry& entry = lamb_aorta().optimizer(name);
  return plugins::create(catalogue().optimizers().at(entry.type), entry.options);
}

}  // namespace tunica::bench
