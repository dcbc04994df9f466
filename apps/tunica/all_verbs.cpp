// SPDX-License-Identifier: Apache-2.0
#include "verbs.hpp"

namespace tunica::app {

void add_verbs(CLI::App& app, GlobalOptions& global, Action& action) {
  for (const auto add :
       {add_run, add_diagnose, add_discover, add_cohort, add_report, add_export, add_certify, add_import, add_check,
        add_simulate, add_stability, add_list, add_describe, add_schema, add_plugin, add_completion, add_man})
    add(app, global, action);
#ifdef TUNICA_SERVES
  add_serve(app, global, action);
  add_studio(app, global, action);
#endif
}

}  // namespace tunica::app
