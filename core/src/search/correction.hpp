// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "tunica/optimizer.hpp"

namespace tunica::search {

/// A first-order additive correction of residuals r_g, which replace the residuals r_f, around a centre x₀:
///
///     r(x) = r_g(x) + [r_f(x₀) − r_g(x₀)] + [J_f(x₀) − J_g(x₀)] (x − x₀),
///
/// Values and derivatives at x₀ are then those of r_f. x is in the unit box of the whole search. It stays between the
/// two corners of the trust region, which is the unit box of the corrected search.
///
/// Source: N. M. Alexandrov, R. M. Lewis, C. R. Gumbert, L. L. Green, P. A. Newman, Approximation and model management
/// in aerodynamic optimization with variable-fidelity models, J. Aircraft 38 (2001) 1093-1101, section 3.
struct Correction {
  std::vector<double> lower, upper;  ///< corners of the trust region, n entries
  std::vector<double> centre;        ///< x₀; empty = no slope
  std::vector<double> offset;        ///< one a residual
  std::vector<double> slope;         ///< [i·n + j], by the unit box of the whole search; empty = none

  /// Corrects residuals and, unless empty, their Jacobian by the trust region, at x in the trust region. Returns the
  /// objective.
  double apply(std::span<const double> x, std::span<const ResidualBlock> blocks, std::span<double> residuals,
               std::span<double> jacobian) const;
};

/// Σ w ρ(‖r‖²) over the blocks.
double objective_of(std::span<const ResidualBlock> blocks, std::span<const double> residuals);

}  // namespace tunica::search
