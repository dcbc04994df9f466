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
struct DruckerVerdict {
  double weakest = 0;                ///< least eigenvalue of D found, kPa
  std::optional<double> first_lost;  ///< stretch on the path where it is first lost
  std::string path;
  std::vector<PathReach> followed;  ///< one a path
};

/// Energy and stress do not change when the axes change places: found by trying at three deformations.
bool is_isotropic(const Model& model, std::span<const double> parameters);

/// For isotropic models. Refers to the paths only while it runs.
DruckerVerdict judge_drucker(const Model& model, std::span<const double> parameters, const std::vector<Path>& paths);

}  // namespace tunica::stability
