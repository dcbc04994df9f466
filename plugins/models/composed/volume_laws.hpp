// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "law_table.hpp"

namespace tunica::composed {

/// Names of the laws of the volume ratio, in the order of the documentation.
const std::vector<std::string>& volume_law_names();

/// The law of this name, which is one of volume_law_names(), as a function of x = J − 1. It vanishes at rest with its
/// slope.
Law volume_law(const std::string& name);

}  // namespace tunica::composed
