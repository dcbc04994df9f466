// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "tunica/plugin.hpp"

// Throws after a first name was added: that name must not stay.
TUNICA_PLUGIN("throwing_registration", "0.1.0") {
  registry.add(
      tunica::OptimizerFactory{"half_registered",
                               "Added before the throw.",
                               "",
                               {},
                               [](const tunica::Options&) -> std::unique_ptr<tunica::Optimizer> { return nullptr; }});
  throw std::runtime_error("the table of materials is missing");
}
