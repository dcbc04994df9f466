// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "tunica/test.hpp"

namespace tunica::abscissa_errors {

/// How the force on a strip became the numbers of its channel `stress`: force per unloaded area = stress · stretch^q,
/// with q = −1 for Cauchy, 0 for first, 1 for second Piola–Kirchhoff stress.
///
/// A test does not say its measure, and is asked for it: the stress of a neo-Hookean strip (Treloar 1943) at stretch 2
/// is μ (λ − λ⁻²) λ^{−q}. None where the answer is none of these.
std::optional<int> force_power(const Test& strip, std::size_t abscissa, std::size_t channel);

}  // namespace tunica::abscissa_errors
