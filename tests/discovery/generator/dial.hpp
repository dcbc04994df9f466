// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects.hpp"
#include "noise.hpp"

namespace blind {

/// How far an effect shows: Λ, the squared misfit of the refitted base model without noise in units of the noise.
struct ScaledEffect {
  HiddenEffect hidden;
  double lambda = 0;    ///< reached
  bool reached = true;  ///< false: no plausible amplitude shows as much as asked; `hidden` is what comes nearest
};

/// The amplitude at which the effect alone has this Λ, to 1 %: every trial is a real refit.
ScaledEffect dial(const Specimen& specimen, const NoiseModel& noise, HiddenEffect hidden, double lambda);

/// The base model refitted to the noise-free observations with all these effects in them, from `start`; its misfit is
/// Λ, infinite where there is no equilibrium.
Refit refit_with(const Specimen& specimen, const NoiseModel& noise, const std::vector<HiddenEffect>& hidden,
                 const Tissue& start);

}  // namespace blind
