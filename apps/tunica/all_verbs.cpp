// SPDX-License-Identifier: Apache-2.0
#include "verbs.hpp"

namespace tunica::app {

void add_verbs(CLI::App& app, GlobalOptions& global, Action& action) {
  for (const auto add : all_verbs) add(app, global, action);
#ifdef TUNICA_SERVES
  add_serve(app, global, action);
  add_studio(app, global, action);
#endif
}

}  // namespace tunica::app
