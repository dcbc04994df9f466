// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tunica/options.hpp"

namespace tunica::plugins {

/// The values of those options that have one by default.
Options default_options(const std::vector<Option>& declared);

}  // namespace tunica::plugins
