// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tunica/options.hpp"

namespace tunica::plugins {

/// The values of those options that have one by default.
Options default_options(const std::vector<Option>& declared);
/// What a mechanism around a test gets: its own options, and under other names those of the test.
Options with_options_of_test(Options own, const Options& test);

}  // namespace tunica::plugins
