// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

TUNICA_PLUGIN("", "0.1.0") {}
