// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../tube_rows/tube_rows.hpp"

namespace tunica::thick_wall {

using Channel = TubeRows::Channel;

/// The test's own parameters, in this order: the native imperfections, each with a null.
enum Own : std::size_t { opening_angle, axial_stretch_error, tethering, thickness_error, layer_ratio, own_count };
/// Layers with models of their own have no layer_ratio, which therefore stands last.
std::vector<Parameter> own_parameters(bool layered);
std::vector<double> own_nulls(bool layered);

constexpr double default_interface = 0.5;

/// The tube as it was bound.
struct Tube : TubeRows {
  bool layered = false;  ///< each layer has a model of its own
  /// Fractions of the thickness where layers meet: those with models, in the unloaded tube; or the two of layer_ratio,
  /// in the sector.
  std::vector<double> interfaces;
  bool same_thickness = false;   ///< the opened sector is as thick as the wall, instead of in equilibrium when closed
  std::size_t gauss_points = 0;  ///< in each layer; 0 = chosen by the estimated error

  [[nodiscard]] std::size_t layer_count() const { return interfaces.size() + 1; }
};

/// Binds options and rows of the test type `name`; throws InputError where they make no tube.
Tube bind(const TestSetup& setup, const char* name);
/// The options that bind() reads beside those of tube_options(): sector and layer_interface.
std::vector<Option> wall_options();

}  // namespace tunica::thick_wall
