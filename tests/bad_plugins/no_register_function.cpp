// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

extern "C" __attribute__((visibility("default"))) const tunica::PluginHeader* tunica_plugin() {
  static constexpr tunica::PluginHeader header{sizeof(tunica::PluginHeader), TUNICA_PLUGIN_API, TUNICA_ABI_FINGERPRINT,
                                               "no_register_function",       "0.1.0",           nullptr};
  return &header;
}
