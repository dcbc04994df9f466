// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "newton_step.hpp"
#include "tunica/detail/free_strip.hpp"
#include "tunica/detail/strip_start.hpp"
#include "tunica/energy_scaled_model.hpp"
#include "uniaxial.hpp"

namespace tunica::uniaxial {

/// The strip whose memory is a factor η(W, Wmax) on the elastic stress: λ2 is that of the elastic strip, and
///
///   σ = η σ_e,   dσ/dp = η dσ_e/dp + σ_e (∂η/∂W dW/dp + ∂η/∂Wmax dWmax/dp + ∂η/∂p).
///
/// In lateral equilibrium ∂W/∂λ2 = 0, so that dW/dp is ∂W/∂p at fixed stretches.
///
/// Writes `rows`; derivatives if `parameters`. The status is that of the elastic strip.
Status scale_elastic(const Strip& strip, const TestInput& input, std::span<const double> stretch,
                     const free_strip::Start& start, const EnergyScaledModel& model, free_strip::Scratch& scratch,
                     const PathRows& rows, bool parameters);

}  // namespace tunica::uniaxial
