// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstdint>
#include <functional>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include "session.hpp"

/// One function per verb: it declares the arguments, and sets `action`, which does the work and returns the exit code.
namespace tunica::app {

using Action = std::function<int()>;

/// A seed on the command line; CLI11 by itself would wrap a negative one around, and take the largest for one beyond.
inline CLI::Validator seed_number() {
  return {[](std::string& text) {
            std::uint64_t seed = 0;
            const char* end = text.data() + text.size();
            const auto [stop, problem] = std::from_chars(text.data(), end, seed);
            if (stop == end && problem == std::errc()) return std::string();
            return "a seed is a whole number from 0 to 18446744073709551615, not '" + text + "'";
          },
          ""};
}

/// Adds the verbs of this program: all of them (all_verbs.cpp), or those that a first result needs (first_verbs.cpp).
void add_verbs(CLI::App& app, GlobalOptions& global, Action& action);

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
void add_studio(CLI::App& app, GlobalOptions& global, Action& action);
void add_stability(CLI::App& app, GlobalOptions& global, Action& action);
void add_list(CLI::App& app, GlobalOptions& global, Action& action);
void add_describe(CLI::App& app, GlobalOptions& global, Action& action);
void add_schema(CLI::App& app, GlobalOptions& global, Action& action);
void add_plugin(CLI::App& app, GlobalOptions& global, Action& action);
void add_completion(CLI::App& app, GlobalOptions& global, Action& action);
void add_man(CLI::App& app, GlobalOptions& global, Action& action);

}  // namespace tunica::app
