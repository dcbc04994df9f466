// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace tunica::posterior {

/// One quantity, chain by chain; all chains are as long.
using Chains = std::vector<std::vector<double>>;

/// Whether chains have come to one distribution, and how many independent draws they are worth. NaN where nothing
/// varies, or chains have fewer than four draws.
struct Convergence {
  double r_hat = 0;           ///< the larger one of values and of distances from the median
  double bulk = 0, tail = 0;  ///< effective sample sizes: of the centre, and the smaller one of the 5 and 95 % points
};

/// Chains are split into halves, and values replaced by the normal scores of their ranks, z = Φ⁻¹((rank − 3/8)/(S +
/// 1/4)). Then, with the variances W within and B between the halves of length n,
///
///   R̂ = √((n − 1)/n + B/(n W)),   ESS = S/(1 + 2 Σ_t ρ_t),
///
/// where the autocorrelations ρ_t of all halves together are summed in pairs as long as these are positive and fall
/// (Geyer's initial monotone sequence). Source: A. Vehtari, A. Gelman, D. Simpson, B. Carpenter, P.-C. Bürkner,
/// Bayesian Analysis 16:667 (2021), sections 3 and 4.
Convergence convergence(const Chains& chains);

/// R̂ and effective sample size of values as they are.
double split_r_hat(const Chains& chains);
double effective_size(const Chains& chains);

/// By linear interpolation among values in ascending order.
double quantile_of(const std::vector<double>& ascending, double share);

}  // namespace tunica::posterior
