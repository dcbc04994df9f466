// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "conformance/verdict.hpp"

namespace tunica::conformance {

/// The verdict of a check that runs in a process of its own: one that crashes, never ends, writes to the terminal or
/// leaves something behind in static memory does so there, and the others go on. An exception, a signal and the end of
/// the time are counter-examples.
Verdict isolated(const std::function<Verdict()>& check, double seconds);

/// The same without a process of its own: for exceptions.
Verdict guarded_check(const std::function<Verdict()>& check);

}  // namespace tunica::conformance
