// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "tunica/detail/free_strip.hpp"
#include "tunica/maxwell_model.hpp"
#include "uniaxial.hpp"

namespace tunica::uniaxial {

/// The strip with Maxwell branches whose material does not tell the lateral axes apart: λ2 = λ3 = λ1^(−½) at every row.
/// With the elastic stress σ, c1 g'_1 = σ/3 and c3 g'_3 = −σ/6, so that memory needs no lateral equilibrium:
///
///   σ + Σ g (⅔ c1 M[σ/c1] + ⅓ c3 M[σ/c3]),   M: h₊ = e^{−x} h + φ ΔS of relaxation.hpp
///
/// M is linear, so that derivatives by parameters of the elastic response go the same way.
///
/// Writes σ11 of n rows (kPa) and, unless the span is empty, its derivative by parameter j of row i at [j·n + i].
/// False where symmetry does not give the answer; where it gives a failure, that is in `status`.
bool remember_symmetric(const Strip& strip, const TestInput& input, std::span<const double> stretch,
                        std::span<const MaxwellModel::Branch> branches, free_strip::Scratch& scratch,
                        std::span<double> stress, std::span<double> stress_dp, Status& status);

}  // namespace tunica::uniaxial
