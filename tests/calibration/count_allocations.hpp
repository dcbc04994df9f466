// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace tunica::fakes {

/// How often operator new is called, by any thread, while `call` runs.
long allocations_in(const std::function<void()>& call);

}  // namespace tunica::fakes
