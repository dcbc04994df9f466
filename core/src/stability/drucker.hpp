// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "stability/deformations.hpp"

namespace tunica::stability {

/// Drucker's condition for an isotropic incompressible material: dτ : dε > 0, τ Kirchhoff stress, ε = ln U. With the
/// energy as a function of two of them, W(ε1, ε2), ε3 = −ε1 − ε2,
///
///   D_ab = ∂²W/∂ε_a∂ε_b positive definite.
///
/// Of a material that changes its volume all three ε are free, and D has three rows.
struct DruckerVerdict {
  double weakest = 0;                ///< least eigenvalue of D found, kPa
  std::optional<double> first_lost;  ///< stretch on the path where it is first lost
  std::string path;
  std::vector<PathReach> followed;  ///< one a path
};

/// Energy and stress do not change when the axes change places: found by trying at three deformations.
bool is_isotropic(const Model& model, std::span<const double> parameters);

/// The least eigenvalue of D at these stretches along t, z, r, kPa; none where the response is not finite.
std::optional<double> least_drucker(const Model& model, std::span<const double> parameters,
                                    const std::array<double, 3>& stretch);

/// For isotropic models. Refers to the paths only while it runs.
DruckerVerdict judge_drucker(const Model& model, std::span<const double> parameters, const std::vector<Path>& paths);

}  // namespace tunica::stability
