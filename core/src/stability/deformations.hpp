// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tunica/model.hpp"

namespace tunica::stability {

/// One state on a homogeneous path of an incompressible material, by its principal stretches (λt, λz, λr).
struct Deformation {
  std::array<double, 3> stretch;
  double along;  ///< the stretch that is prescribed on the path
};

struct Path {
  std::string name;  ///< "circumferential strip", "equibiaxial", …
  std::vector<Deformation> points;
};

/// How far along a path a condition could be asked: the response may end before the path does.
struct PathReach {
  std::string path;
  double to = 1;  ///< stretch; 1 = nowhere
};

/// The homogeneous paths from rest to the stretch `limit`: a free strip along either axis, equibiaxial extension, pure
/// shear along either axis; evenly spaced in ln λ. A strip ends where it has no equilibrium any more.
std::vector<Path> homogeneous_paths(const Model& model, std::span<const double> parameters, double limit);

}  // namespace tunica::stability
