// SPDX-License-Identifier: Apache-2.0
#include "verbs.hpp"

namespace tunica::app {

void add_verbs(CLI::App& app, GlobalOptions& global, Action& action) {
  for (const auto add : first_verbs) add(app, global, action);
}

}  // namespace tunica::app
