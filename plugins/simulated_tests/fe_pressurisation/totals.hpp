// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../thick_wall_pressurisation/sector.hpp"
#include "simulation.hpp"

namespace tunica::fe {

/// Derivatives of what is observed by the model's parameters and by the test's own, in their order: those of a sample
/// at a fixed sector, and what the sector does that closes to the tube. See thick_wall::Own.
void total_derivatives(const Sample& sample, const thick_wall::Wall& wall, const thick_wall::SectorDerivative& sector,
                       std::size_t model_parameters, std::vector<Observed>& totals);

}  // namespace tunica::fe
