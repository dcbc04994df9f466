// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "stability/deformations.hpp"

namespace tunica::stability {

/// Strong ellipticity of an incompressible material (Legendre–Hadamard):
///
///   m·Q(n) m > 0 for all unit n and m ⊥ n,   Q_ij(n) = (n·σ n) δ_ij + F_iI F_jJ F_pK F_qL n_p n_q ℂ_IKJL,
///
/// ℂ = 2 ∂S/∂C, σ = F S Fᵀ. A hydrostatic pressure, and any function of det F added to W, drop out for m ⊥ n (Ogden,
/// Non-Linear Elastic Deformations, 1984, §6.2). Lost where waves stop: the material
/// localises in bands. Of a material that changes its volume m is any unit vector, and Q is per volume at rest: n·σ n
/// with Kirchhoff's stress F S Fᵀ in the place of σ.
struct EllipticityVerdict {
  double weakest = 0;                ///< least m·Q m found, kPa
  std::optional<double> first_lost;  ///< stretch on the path where it is first lost
  std::string path;                  ///< that path, or the one where `weakest` was found
  std::array<double, 3> n{}, m{};    ///< normal of the band and direction of its shear, components along t, z, r
  std::vector<PathReach> followed;   ///< one a path
};

/// Over all points of the paths and a few hundred directions n spread over half the sphere; the least eigenvalue of Q
/// in the plane normal to n is exact for each n. Of a model that is compressible it is that of all of Q, and the
/// direction n is refined. A point whose response is not finite ends its path.
EllipticityVerdict judge_ellipticity(const Model& model, std::span<const double> parameters,
                                     const std::vector<Path>& paths);

/// Least m·Q m at one state of stretches along t, z, r, kPa, over the same directions; none where the response is not
/// finite.
std::optional<double> least_wave_stiffness(const Model& model, std::span<const double> parameters,
                                           const std::array<double, 3>& stretches);

/// Sets n and m of the verdict to those of that least value.
void set_weakest_wave(const Model& model, std::span<const double> parameters, const Deformation& at,
                      EllipticityVerdict& verdict);

}  // namespace tunica::stability
