// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stability/drucker.hpp"
#include "stability/ellipticity.hpp"

namespace tunica::stability {

/// Whether a state of a compressible material is a minimum of W over the stretches of its free faces. With ε_k = ln λ_k
/// across them, and S_kk = 0,
///
///   K_kl = ∂²W/∂ε_k∂ε_l = c_k c_l (2 ∂S/∂C)_kkll positive definite.
struct FreeFaceVerdict {
  double weakest = 0;                ///< least eigenvalue of K found, kPa
  std::optional<double> first_lost;  ///< stretch on the path where it is first lost
  std::string path;
  std::vector<PathReach> followed;  ///< one a path with free faces
};

/// The verdict on a material that changes its volume: no condition constrains J.
struct CompressibleVerdict {
  EllipticityVerdict ellipticity;
  FreeFaceVerdict free_faces;
  std::optional<DruckerVerdict> drucker;  ///< isotropic models
};

/// Along homogeneous paths, from rest: free strips along either axis and equibiaxial sheets, pulled to the stretch
/// `largest` and pressed to `least`; pure shear of a sheet along either axis; confined compression; a change of volume
/// without one of shape, from J = `least` to `largest`, whose stretch is J^(1/3). Free faces are solved for. A path
/// ends where the response does, and a condition is followed to where it is lost, which is bisected to 1e-9.
CompressibleVerdict judge_compressible(const Model& model, std::span<const double> parameters, double least,
                                       double largest);

}  // namespace tunica::stability
