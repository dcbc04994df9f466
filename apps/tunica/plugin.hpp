// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verbs.hpp"

/// The verbs below `tunica plugin`.
namespace tunica::app {

void add_plugin_new(CLI::App& plugin, GlobalOptions& global, Action& action);
void add_plugin_check(CLI::App& plugin, GlobalOptions& global, Action& action);

}  // namespace tunica::app
