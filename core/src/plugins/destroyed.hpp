// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "plugins/calls.hpp"
#include "plugins/casualties.hpp"

namespace tunica::plugins {

/// Destroys the object of a plugin in a watched call. Where this has ended a process before, the plugin's objects are
/// left where they are.
template <class Object>
void destroy(const std::string& plugin, std::unique_ptr<Object>& object) {
  if (!object) return;
  const Call call{plugin.c_str(), "destroy", [](const Call& one) { return CallKey(one.plugin, one.what).value(); },
                  nullptr};
  if (is_stricken(plugin) && !refusal(plugin, call.key(call)).empty()) {
    static_cast<void>(object.release());
    return;
  }
  const CallScope scope(call);
  object.reset();
}

}  // namespace tunica::plugins
