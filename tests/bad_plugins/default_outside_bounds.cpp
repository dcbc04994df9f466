// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

TUNICA_PLUGIN("default_outside_bounds", "0.1.0") {
  registry.add(
      tunica::OptimizerFactory{"too_many_starts",
                               "Begins at more places than it allows.",
                               "",
                               {tunica::Option::integer("starts", 20, {1, 10}, "Where it begins.")},
                               [](const tunica::Options&) -> std::unique_ptr<tunica::Optimizer> { return nullptr; }});
}
