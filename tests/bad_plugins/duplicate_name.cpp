// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

// Two names, the second of them taken by the plugin `good`: neither may appear.
TUNICA_PLUGIN("duplicate_name", "0.1.0") {
  const auto create = [](const tunica::Options&) -> std::unique_ptr<tunica::Optimizer> { return nullptr; };
  registry.add(tunica::OptimizerFactory{"unheard_of", "New name.", "", {}, create});
  registry.add(tunica::OptimizerFactory{"does_nothing", "Taken name.", "", {}, create});
}
