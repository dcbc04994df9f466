// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

extern "C" __attribute__((visibility("default"))) const tunica::PluginHeader* tunica_plugin() { return nullptr; }
