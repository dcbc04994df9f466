// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

TUNICA_PLUGIN("non_standard_throw", "0.1.0") { throw 42; }
