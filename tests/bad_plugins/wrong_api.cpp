// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

// Everything but the number would crash if it were read: the number must be looked at first.
extern "C" __attribute__((visibility("default"))) const tunica::PluginHeader* tunica_plugin() {
  static constexpr tunica::PluginHeader header{
      sizeof(tunica::PluginHeader), TUNICA_PLUGIN_API + 41, nullptr, nullptr, nullptr, nullptr};
  return &header;
}
