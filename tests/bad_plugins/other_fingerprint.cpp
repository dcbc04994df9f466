// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

TUNICA_PLUGIN("other_fingerprint", "0.1.0") {}
