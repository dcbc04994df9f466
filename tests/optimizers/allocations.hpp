// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tunica::testing {

/// Calls of operator new in this executable so far, those of loaded plugins included.
std::uint64_t allocations();

}  // namespace tunica::testing
