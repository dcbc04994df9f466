// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "settings.hpp"
#include "tunica/options.hpp"

namespace tunica::es {

/// The options that `es` and `cma_es` share, with a default for the first step of the mutations.
inline std::vector<Option> search_options(double initial_step) {
  return {
      Option::number("initial_step", initial_step, {1e-6, 1},
                     "First standard deviation of the mutations, as a fraction of the range of each parameter."),
      Option::integer("restarts", 10, {0, 1e6},
                      "Further searches from new random points after one has converged or stalled, as far as the "
                      "stop block allows."),
      Option::number("restart_growth", 2, {1, 10}, "Factor on the population at every restart; 1 keeps it."),
      Option::integer("stall_generations", 30, {1, 1e6}, "A search ends after this many generations without progress."),
      Option::number("tolerance", 1e-9, {0, 1}, "Relative improvement of the objective that counts as progress."),
      Option::number("step_tolerance", 1e-12, {0, 1},
                     "A search ends when the mean mutation is shorter than this fraction of the range.")};
}

/// Reads the shared options into settings.
inline void set_search_options(const Options& given, Settings& settings) {
  settings.initial_step = given.number("initial_step");
  settings.restarts = given.count("restarts");
  settings.restart_growth = given.number("restart_growth");
  settings.stall_generations = given.count("stall_generations");
  settings.tolerance = given.number("tolerance");
  settings.step_tolerance = given.number("step_tolerance");
}

}  // namespace tunica::es
