// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sections.hpp"

namespace tunica::thick_wall {

/// How the radius of the stress-free sector moves, ι = ln R_i.
struct SectorDerivative {
  double by_closing = 0, by_area = 0, by_ratio = 0;
  std::vector<double> by_parameter;  ///< of the models
};

/// Closes the stress-free sector: sets wall.iota, and with `derivative` how it depends on everything.
///
/// The one unknown R_i is fixed by the one condition that the closed, unloaded, unstretched tube (λz = 1) of the
/// measured outer radius is in equilibrium without pressure. Without an opening angle nothing is solved: R_i = Ri.
/// Fibres switch on at rest, half of the wall being on either side; the derivative at α = 0 is then different for
/// either sign of α, and the mean of both is given.
/// `same_thickness`: a sector as thick as the wall instead, whatever the material.
Status close_sector(const Tube& tube, const Layers& layers, const Rule& rule, Sections& sections, Wall& wall,
                    SectorDerivative* derivative);

}  // namespace tunica::thick_wall
