// SPDX-License-Identifier: Apache-2.0
#include "plugin.hpp"

#include "verbs.hpp"

namespace tunica::app {

void add_plugin(CLI::App& app, GlobalOptions& global, Action& action) {
  auto* verb = app.add_subcommand("plugin", "Start a plugin of your own, or check one");
  verb->require_subcommand(1);
  verb->footer(
      "Examples:\n  tunica plugin new model my_model      a project that builds and passes\n"
      "  tunica plugin check build/my_model.so  what every model has to hold");
  add_plugin_new(*verb, global, action);
  add_plugin_check(*verb, global, action);
}

}  // namespace tunica::app
