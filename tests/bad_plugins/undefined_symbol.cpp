// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

extern "C" double nobody_defines_this();

TUNICA_PLUGIN("undefined_symbol", "0.1.0") {
  if (nobody_defines_this() > 0) return;
}
