// SPDX-License-Identifier: Apache-2.0
#include "verbs.hpp"

namespace tunica::app {

void add_verbs(CLI::App& app, GlobalOptions& global, Action& action) {
  for (const auto add : {add_run, add_diagnose, add_report, add_certify, add_check, add_simulate, add_stability,
                         add_list, add_describe, add_schema})
    add(app, global, action);
}

}  // namespace tunica::app
