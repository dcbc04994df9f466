// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "posterior/counter_random.hpp"
#include "posterior/target.hpp"

namespace tunica::posterior {

/// A step along the predictions instead of the parameters: valleys bend in the parameters, but hardly in the rows H,
/// for the curvature of nonlinear regression is mostly that of its parameters (D. M. Bates, D. G. Watts, J. R. Stat.
/// Soc. B 42:1, 1980). With Q(z) an orthonormal basis of the columns of ∂H/∂z and y = Qᵀ H, which is N(0, I) where H is
/// linear,
///
///   Q(z)ᵀ H(z') = √(1 − β²) y + β e,   e ~ N(0, I)   (a proposal that keeps N(0, I): S. L. Cotter et al., Stat. Sci.
///                                                     28:424, 2013)
///
/// is solved for z' by Newton's method from z. The density of the proposal is N(e) |det Q(z)ᵀ ∂H/∂z(z')|/βⁿ, and the
/// step is accepted by Metropolis and Hastings. Where Newton's method with Q(z') does not come back from z' to z, it is
/// refused: so it is right too where H does not name z uniquely.
///
/// Sources: parameters from perturbed rows, J. M. Bardsley, A. Solonen, H. Haario, M. Laine, SIAM J. Sci. Comput.
/// 36:A1895 (2014); steps on the tangent with a way back, E. Zappa, M. Holmes-Cerfon, J. Goodman, Comm. Pure Appl.
/// Math. 71:2609 (2018).
///
/// Moves `here`, or leaves it; returns the probability with which it was to move, 0 where there was nowhere to go.
/// `size`: β, above 0, below 1. Five to ten simulations where H is nearly linear, tens in a strongly bent valley.
double make_tangent_move(Target& target, Point& here, double size, CounterRandom& random);

}  // namespace tunica::posterior
