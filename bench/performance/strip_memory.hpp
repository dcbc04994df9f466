// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "assembly/layout.hpp"
#include "floors.hpp"

namespace tunica::bench {

/// The memory traffic of one strip's floor.
struct StripMemory {
  std::vector<double> pulled, measured, lateral, residual, jacobian;

  StripMemory(const assembly::MeasuredChannel& channel)
      : measured(channel.measured), residual(measured.size()), jacobian(6 * measured.size()) {
    for (const double stretch : channel.abscissa) {
      pulled.push_back(stretch * stretch);
      lateral.push_back(1 / stretch);
    }
  }
  floors::Strip strip(bool axial, bool wants_jacobian, int steps) {
    return {pulled.size(),
            steps,
            axial,
            pulled.data(),
            measured.data(),
            lateral.data(),
            wants_jacobian ? residual.data() : nullptr,
            wants_jacobian ? jacobian.data() : nullptr};
  }
};

}  // namespace tunica::bench
