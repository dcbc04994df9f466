// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

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

/// How far the minimum of the objective moves, in the unit box, where all predictions change by `change`: to first
/// order −H⁻¹ (∂g/∂ŷ) change, of which `moving` parameters take part and the others stay. `shift`: one a parameter.
Status minimum_shift(const assembly::Assembly& assembly, std::span<const double> free,
                     std::span<const std::size_t> moving, std::span<const double> change, std::span<double> shift);

/// What the rise of the objective J along the profile of each parameter has to be divided by to rise as −2 ln L does.
/// Near the minimum the profile is (p − p̂)²/(2 (H⁻¹)_jj), while the estimate has the variance (H⁻¹ M H⁻¹)_jj, so that
///
///   J(p) − J(p̂)  is distributed as  λ_j χ²₁,   λ_j = (H⁻¹ M H⁻¹)_jj / (2 (H⁻¹)_jj)
///
/// (J. T. Kent, Biometrika 69:19, 1982). 1 for least squares with stated noise and weights 1. Parameters at bounds stay
/// there, except in their own profile; directions that the data do not see count for nothing. `scales`: one a
/// parameter; `measured` stands in for the data unless empty.
Status objective_scales(const assembly::Assembly& assembly, std::span<const double> free,
                        const assembly::Whitening& noise, std::span<const double> measured,
                        std::vector<double>& scales);

}  // namespace tunica::uncertainty
