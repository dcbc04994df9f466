// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "tunica/test.hpp"

namespace tunica::abscissa_errors {

/// How the force on a strip, or along one direction of a sheet, became the numbers of its channel: force per unloaded
/// area = stress · stretch^q, with q = −1 for Cauchy, 0 for first, 1 for second Piola–Kirchhoff stress.
///
/// A test does not say its measure, and is asked for it: the stress of a neo-Hookean strip (Treloar 1943) at stretch 2
/// is μ (λ − λ⁻²) λ^{−q}, that of a sheet μ (λ − λ⁻³) λ^{−q} where the other direction is held at 1, and μ (λ − λ⁻⁵)
/// λ^{−q} where both are pulled alike. No two of these are equal. None where the answer is none of them.
std::optional<int> force_power(const Test& test, std::size_t abscissa, std::size_t channel);

}  // namespace tunica::abscissa_errors
