// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

/// Symmetric tensors of one material point, components tt, zz, rr, tz, zr, tr.
namespace tunica::viscoelasticity {

using Tensor = std::array<double, 6>;
using Tangent = std::array<double, 36>;  ///< row-major: 2 ∂S_a/∂C_b at [6a + b], tensor components

/// A : B; off-diagonal components count twice.
double contract(const Tensor& a, const Tensor& b);

/// det C and C⁻¹ by cofactors.
Tensor inverse(const Tensor& C);

/// The part of S that does work when the shape changes and the volume does not,
///
///   Dev S = S − ⅓ (S : C) C⁻¹,
///
/// (Holzapfel 2000, Nonlinear Solid Mechanics, eq. 6.91). A function of the volume added to the energy, W + f(J),
/// adds J f'(J) C⁻¹ to S, and nothing to Dev S.
Tensor deviator(const Tensor& S, const Tensor& C, const Tensor& C_inverse);

/// 2 ∂(Dev S)/∂C from A = 2 ∂S/∂C:
///
///   A − ⅓ [ C⁻¹ ⊗ (2 S + C : A) + (S : C) 2 ∂C⁻¹/∂C ],  2 ∂C⁻¹_ij/∂C_kl = −(C⁻¹_ik C⁻¹_jl + C⁻¹_il C⁻¹_jk).
Tangent deviator_tangent(const Tensor& S, const Tangent& A, const Tensor& C, const Tensor& C_inverse);

}  // namespace tunica::viscoelasticity
