// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "population/alternation.hpp"

namespace tunica::population {

/// The means of the population, corrected for what the quadratics of the specimens leave out.
struct Integration {
  std::vector<Expansion> expansions;  ///< about the maxima at these means, with Expansion::pull and bend
  Means means;                        ///< with of_specimen_covariance
};

/// A linearised specimen has its mean a posteriori at its maximum; a curved one has not. Where specimens fix a
/// parameter poorly, the population inherits the difference. Here the true mean ξ̄_i comes from importance sampling
/// about the maximum ξ₀, as in J. C. Pinheiro, D. M. Bates, J. Comput. Graph. Stat. 4:12 (1995), with 256 points of
/// Sobol's sequence, shifted for every specimen so that their errors do not add up. Then
///
///   ΔA = C⁻¹ − Ω⁻¹ − A,   u = −g − (A + ΔA)(ξ̄ − ξ₀) − Ω⁻¹ (ξ̄ − m)
///
/// are added to information and score of the specimen, with its covariance a posteriori C. The linear model then has
/// its mean at ξ̄. So β solves Σ X_iᵀ Ω⁻¹ (ξ̄_i − m_i) = 0, the score of the true likelihood (Fisher's identity). In a
/// linear model β does not depend on small errors of Ω; here it does, and their covariance is added to that of the
/// alternation: D V Dᵀ, with the slopes D of β by Ω and the covariance V of Ω.
///
/// Two Newton steps are made: a third moves β by a hundredth of its error. Variances and likelihood stay those of the
/// alternation, because a fixed score would drive a growing Ω on; and where Ω is all but singular, more steps lead
/// away. Without Cohort::misfits, this is the alternation. The same bits for any number of threads.
Integration integrate(const Cohort& cohort, const Form& form, const Alternation& fit);

}  // namespace tunica::population
