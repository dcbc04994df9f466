// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace tunica::plugins {

/// Whether a person ended the work. execution::InterruptWatch raises it; searches ask, and tests that wait for
/// something outside of the process ask through TestSetup::interrupted.
inline std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

}  // namespace tunica::plugins
