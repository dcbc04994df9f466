// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "session.hpp"

/// One function a verb: declares its arguments, and puts what it does into `action`, which returns the exit code.
namespace tunica::app {

using Action = std::function<int()>;

/// A seed on the command line; CLI11 by itself would wrap a negative one around.
inline CLI::Validator seed_number() {
  return {[](std::string& text) {
            const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
            return digits ? std::string() : "a seed is a whole number from 0, not '" + text + "'";
          },
          ""};
}

void add_run(CLI::App& app, GlobalOptions& global, Action& action);
void add_cohort(CLI::App& app, GlobalOptions& global, Action& action);
void add_diagnose(CLI::App& app, GlobalOptions& global, Action& action);
void add_discover(CLI::App& app, GlobalOptions& global, Action& action);
void add_report(CLI::App& app, GlobalOptions& global, Action& action);
void add_export(CLI::App& app, GlobalOptions& global, Action& action);
void add_certify(CLI::App& app, GlobalOptions& global, Action& action);
void add_import(CLI::App& app, GlobalOptions& global, Action& action);
void add_check(CLI::App& app, GlobalOptions& global, Action& action);
void add_simulate(CLI::App& app, GlobalOptions& global, Action& action);
void add_serve(CLI::App& app, GlobalOptions& global, Action& action);
void add_stability(CLI::App& app, GlobalOptions& global, Action& action);
void add_list(CLI::App& app, GlobalOptions& global, Action& action);
void add_describe(CLI::App& app, GlobalOptions& global, Action& action);
void add_schema(CLI::App& app, GlobalOptions& global, Action& action);
void add_plugin(CLI::App& app, GlobalOptions& global, Action& action);
void add_completion(CLI::App& app, GlobalOptions& global, Action& action);
void add_man(CLI::App& app, GlobalOptions& global, Action& action);

}  // namespace tunica::app
