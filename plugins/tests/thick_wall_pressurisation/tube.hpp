// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../tube_rows/tube_rows.hpp"

namespace tunica::thick_wall {

using Channel = TubeRows::Channel;

/// The test's own parameters, in this order: the native imperfections, each with a null.
enum Own : std::size_t { opening_angle, axial_stretch_error, tethering, thickness_error, layer_ratio, own_count };
std::vector<Parameter> own_parameters();
std::vector<double> own_nulls();

/// The tube as it was bound.
struct Tube : TubeRows {
  double layer_interface = 0.5;  ///< where the inner layer ends, as a fraction of the thickness
  bool same_thickness = false;   ///< the opened sector is as thick as the wall, instead of in equilibrium when closed
  std::size_t gauss_points = 0;  ///< in each layer; 0 = chosen by the estimated error
};

/// Binds options and rows; throws InputError where they make no tube.
Tube bind(const TestSetup& setup);

}  // namespace tunica::thick_wall
