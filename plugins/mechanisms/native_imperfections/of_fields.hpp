// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tunica/mechanism.hpp"

namespace tunica::native {

/// Mechanisms that the test full_field simulates itself: how its sheet was held, and where it is not even.
std::vector<MechanismFactory> of_fields();

}  // namespace tunica::native
