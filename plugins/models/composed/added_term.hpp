// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tunica/mechanism.hpp"

namespace tunica::composed {

/// The mechanism `added_term`: one term of `composed`, of any invariant and law, beside the energy of any model.
MechanismFactory added_term();

}  // namespace tunica::composed
