// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tunica::uniaxial {

/// What a Maxwell branch of stiffness 1 keeps over each time step x = Δt/τ, and takes up:
///
///   h₊ = e^{−x} h + φ ΔS,   φ = (1 − e^{−x})/x,
///   ∂h₊/∂τ = e^{−x} ∂h/∂τ + (x e^{−x} h − (e^{−x} − φ) ΔS)/τ
///
/// Time s, of `count` rows from `first` on; the first row of all follows rest at time 0.
struct Relaxation {
  std::vector<double> decay,  ///< e^{−x}
      taken,                  ///< φ
      by_tau,                 ///< −(e^{−x} − φ)/τ
      by_tau_of_h;            ///< x e^{−x}/τ
  void set(std::span<const double> time, std::size_t first, std::size_t count, double tau);
};

}  // namespace tunica::uniaxial
