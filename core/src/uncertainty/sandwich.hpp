// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "assembly/whitening.hpp"
#include "uncertainty/valleys.hpp"

namespace tunica::uncertainty {

/// From the spectrum of the likelihood to that of the estimator that was used, the minimum of Σ w ρ(‖r‖²) over residual
/// blocks. To first order it moves with the errors e of the measurement by −H⁻¹ ∂g/∂e, g the gradient, so that
///
///   cov x = H⁻¹ M H⁻¹,   H = Σ_b 2 w ρ' J_bᵀ J_b,   M = B Bᵀ,   B = Σ_b 2 w ρ' J_bᵀ D_b L,
///
/// J the Jacobian of the residuals r = D e, L Lᵀ the covariance of e, ρ' = 1, or 1/(2‖r‖) of the root, taken as fixed
/// (the sandwich of Huber 1967 and White, Econometrica 50:1-25, 1982). For least squares with stated noise and weights
/// 1 that is the inverse of JᵀJ, as in the likelihood. Directions that the data do not see stay as they are.
Status apply_sandwich(const assembly::Assembly& assembly, std::span<const double> free,
                      const assembly::Whitening& noise, Spectrum& spectrum);

}  // namespace tunica::uncertainty
